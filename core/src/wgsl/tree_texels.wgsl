// The acceleration structure in images, as CPUs read it: lavapipe reads texels for a vector at once, words of a buffer lane by
// lane, each behind branches of its own.

var nodes: texture_2d<u32>;
// Three texels a primitive, in the order of the leaves: the corners of a triangle, or a sphere.
var primitives: texture_2d<u32>;

// A fifth of a node.
fn tree_node(index: u32, part: u32) -> vec4u {
    return textureLoad(nodes, tree_texel(5u * index + part), 0);
}

fn tree_corner(primitive: u32, corner: u32) -> vec3f {
    return bitcast<vec3f>(textureLoad(primitives, tree_texel(3u * primitive + corner), 0).xyz);
}

// The number that tells a sphere from a triangle.
fn tree_mark(primitive: u32) -> f32 {
    return tree_corner(primitive, 1u).y;
}

fn tree_texel(index: u32) -> vec2u {
    return vec2u(index % TEXEL_ROW, index / TEXEL_ROW);
}

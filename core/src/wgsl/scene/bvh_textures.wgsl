// The acceleration structure and the shading data of its primitives in images, for CPUs.

var nodes: texture_2d<u32>;
// Three texels per primitive in the order of the leaves: the corners of a triangle, or a sphere.
var primitives: texture_2d<u32>;
// Octahedral normals of a primitive's three corners, and object | SURFACE_* flags.
var shading: texture_2d<u32>;

// Reads a part of 16 of a node's 80 bytes.
fn bvh_node(index: u32, part: u32) -> vec4u {
    return textureLoad(nodes, storage_texel(5u * index + part), 0);
}

fn bvh_corner(primitive: u32, corner: u32) -> vec3f {
    return bitcast<vec3f>(textureLoad(primitives, storage_texel(3u * primitive + corner), 0).xyz);
}

// The number that marks spheres among the primitives.
fn bvh_mark(primitive: u32) -> f32 {
    return bvh_corner(primitive, 1u).y;
}

fn shading_at(primitive: u32) -> vec4u {
    return textureLoad(shading, storage_texel(primitive), 0);
}

// The acceleration structure and the surfaces of its primitives in buffers, as GPUs read them.

var<storage, read> nodes: array<vec4u>;
// Nine numbers a primitive, in the order of the leaves: the corners of a triangle, or a sphere.
var<storage, read> primitives: array<f32>;
// Normals of a primitive's corners (octahedral), and object | SURFACE_* flags.
var<storage, read> shading: array<vec4u>;

// Reads 16 of a node's 80 bytes.
fn bvh_node(index: u32, part: u32) -> vec4u {
    return nodes[5u * index + part];
}

fn bvh_corner(primitive: u32, corner: u32) -> vec3f {
    let i = 9u * primitive + 3u * corner;
    return vec3f(primitives[i], primitives[i + 1u], primitives[i + 2u]);
}

// The number that tells a sphere from a triangle.
fn bvh_mark(primitive: u32) -> f32 {
    return primitives[9u * primitive + 4u];
}

fn shading_at(primitive: u32) -> vec4u {
    return shading[primitive];
}

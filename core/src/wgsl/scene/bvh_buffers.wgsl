// The acceleration structure and the shading data of its primitives in buffers, for GPUs.

var<storage, read> nodes: array<vec4u>;
// Nine numbers per primitive in the order of the leaves: the corners of a triangle, or a sphere.
var<storage, read> primitives: array<f32>;
// Octahedral normals of a primitive's three corners, and object | SURFACE_* flags.
var<storage, read> shading: array<vec4u>;

// Reads a part of 16 of a node's 80 bytes.
fn bvh_node(index: u32, part: u32) -> vec4u {
    return nodes[5u * index + part];
}

fn bvh_corner(primitive: u32, corner: u32) -> vec3f {
    let i = 9u * primitive + 3u * corner;
    return vec3f(primitives[i], primitives[i + 1u], primitives[i + 2u]);
}

// The number that marks spheres among the primitives.
fn bvh_mark(primitive: u32) -> f32 {
    return primitives[9u * primitive + 4u];
}

fn shading_at(primitive: u32) -> vec4u {
    return shading[primitive];
}

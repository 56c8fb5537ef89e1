// Texture coordinates and colours of a primitive's corners in a buffer, for GPUs: three pairs of coordinates,
// then three colours, each if present.

var<storage, read> vertices: array<u32>;

// Words per primitive: 6 of texture coordinates, 3 of colours.
fn vertex_stride() -> u32 {
    if VERTEX_STRIDE_KNOWN {
        return VERTEX_STRIDE;
    }
    return arrayLength(&vertices) / arrayLength(&shading);
}

// Texture coordinates of the three corners.
fn vertex_texcoords(primitive: u32) -> array<vec2f, 3> {
    let stride = vertex_stride();
    if stride < 6u {
        return array<vec2f, 3>();
    }
    let i = primitive * stride;
    return array<vec2f, 3>(vertex_corner_texcoord(i), vertex_corner_texcoord(i + 2u), vertex_corner_texcoord(i + 4u));
}

fn vertex_corner_texcoord(index: u32) -> vec2f {
    return vec2f(bitcast<f32>(vertices[index]), bitcast<f32>(vertices[index + 1u]));
}

// Colours of the three corners, and a flag for their presence.
fn vertex_colors(primitive: u32) -> vec4u {
    let stride = vertex_stride();
    if stride != 3u && stride != 9u {
        return vec4u(0u);
    }
    let i = primitive * stride + (stride - 3u);
    return vec4u(vertices[i], vertices[i + 1u], vertices[i + 2u], 1u);
}

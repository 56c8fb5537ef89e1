// Texture coordinates and colours of a primitive's corners in a buffer, for GPUs: three pairs of coordinates, then
// three colours of 16 bits a channel, if present.

var<storage, read> vertices: array<u32>;

// Words per primitive: 6 of texture coordinates, 6 of colours.
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

// Colours of the three corners; white if there are none.
fn vertex_colors(primitive: u32) -> array<vec2u, 3> {
    let stride = vertex_stride();
    if stride < 12u {
        let white = vec2u(0xffffffffu);
        return array<vec2u, 3>(white, white, white);
    }
    let i = primitive * stride + 6u;
    return array<vec2u, 3>(vertex_words(i), vertex_words(i + 2u), vertex_words(i + 4u));
}

fn vertex_words(index: u32) -> vec2u {
    return vec2u(vertices[index], vertices[index + 1u]);
}

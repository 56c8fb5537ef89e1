// Texture coordinates and colours of a primitive's corners: three pairs of numbers, then three colours, as far
// as the scene has them.

var<storage, read> vertices: array<u32>;

// Words a primitive: 6 of texture coordinates, 3 of colours.
fn vertex_stride() -> u32 {
    if VERTEX_STRIDE_KNOWN {
        return VERTEX_STRIDE;
    }
    return arrayLength(&vertices) / arrayLength(&shading);
}

fn vertex_corner_texcoord(index: u32) -> vec2f {
    return vec2f(bitcast<f32>(vertices[index]), bitcast<f32>(vertices[index + 1u]));
}

// Of the three corners.
fn vertex_texcoords(primitive: u32) -> array<vec2f, 3> {
    let stride = vertex_stride();
    if stride < 6u {
        return array<vec2f, 3>();
    }
    let i = primitive * stride;
    return array<vec2f, 3>(vertex_corner_texcoord(i), vertex_corner_texcoord(i + 2u), vertex_corner_texcoord(i + 4u));
}

fn vertex_texcoord(hit: Hit) -> vec2f {
    let stride = vertex_stride();
    if stride < 6u {
        return vec2f(0.0);
    }
    let i = hit.primitive * stride;
    return (1.0 - hit.u - hit.v) * vertex_corner_texcoord(i) + hit.u * vertex_corner_texcoord(i + 2u)
        + hit.v * vertex_corner_texcoord(i + 4u);
}

fn vertex_color(hit: Hit) -> vec3f {
    let stride = vertex_stride();
    if stride != 3u && stride != 9u {
        return vec3f(1.0);
    }
    let i = hit.primitive * stride + (stride - 3u);
    return (1.0 - hit.u - hit.v) * unpack4x8unorm(vertices[i]).rgb + hit.u * unpack4x8unorm(vertices[i + 1u]).rgb
        + hit.v * unpack4x8unorm(vertices[i + 2u]).rgb;
}

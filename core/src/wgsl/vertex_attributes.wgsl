// Texture coordinates and colours of a primitive's corners: three pairs of numbers, then three colours, as far
// as the scene has them.

var<storage, read> vertices: array<u32>;

const VERTEX_COLORS: u32 = select(0u, 6u, VERTEX_HAS_TEXCOORDS);
const VERTEX_STRIDE: u32 = VERTEX_COLORS + select(0u, 3u, VERTEX_HAS_COLORS);

fn vertex_corner_texcoord(index: u32) -> vec2f {
    return vec2f(bitcast<f32>(vertices[index]), bitcast<f32>(vertices[index + 1u]));
}

fn vertex_texcoord(hit: Hit) -> vec2f {
    if !VERTEX_HAS_TEXCOORDS {
        return vec2f(0.0);
    }
    let i = hit.primitive * VERTEX_STRIDE;
    return (1.0 - hit.u - hit.v) * vertex_corner_texcoord(i) + hit.u * vertex_corner_texcoord(i + 2u)
        + hit.v * vertex_corner_texcoord(i + 4u);
}

fn vertex_color(hit: Hit) -> vec3f {
    if !VERTEX_HAS_COLORS {
        return vec3f(1.0);
    }
    let i = hit.primitive * VERTEX_STRIDE + VERTEX_COLORS;
    return (1.0 - hit.u - hit.v) * unpack4x8unorm(vertices[i]).rgb + hit.u * unpack4x8unorm(vertices[i + 1u]).rgb
        + hit.v * unpack4x8unorm(vertices[i + 2u]).rgb;
}

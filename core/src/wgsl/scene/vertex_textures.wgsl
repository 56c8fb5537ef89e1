// Texture coordinates and colours of a primitive's corners in an image, for CPUs: a texel with the coordinates of two
// corners, one with those of the third and its colour, one with the colours of the first two; colours are inverted.

var vertices: texture_2d<u32>;

// Texture coordinates of the three corners.
fn vertex_texcoords(primitive: u32) -> array<vec2f, 3> {
    if VERTEX_STRIDE_KNOWN && VERTEX_STRIDE < 6u {
        return array<vec2f, 3>();
    }
    let ab = bitcast<vec4f>(textureLoad(vertices, storage_texel(3u * primitive), 0));
    let c = bitcast<vec4f>(textureLoad(vertices, storage_texel(3u * primitive + 1u), 0));
    return array<vec2f, 3>(ab.xy, ab.zw, c.xy);
}

// Colours of the three corners; white if there are none.
fn vertex_colors(primitive: u32) -> array<vec2u, 3> {
    if VERTEX_STRIDE_KNOWN && VERTEX_STRIDE < 12u {
        let white = vec2u(0xffffffffu);
        return array<vec2u, 3>(white, white, white);
    }
    let ab = textureLoad(vertices, storage_texel(3u * primitive + 2u), 0);
    let c = textureLoad(vertices, storage_texel(3u * primitive + 1u), 0);
    return array<vec2u, 3>(~ab.xy, ~ab.zw, ~c.zw);
}

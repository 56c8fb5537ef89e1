// Texture coordinates and colours of a primitive's corners in an image, for CPUs: two texels of coordinates, then
// one of colours with a flag for their presence.

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

// Colours of the three corners, and a flag for their presence.
fn vertex_colors(primitive: u32) -> vec4u {
    if VERTEX_STRIDE_KNOWN && VERTEX_STRIDE % 6u == 0u {
        return vec4u(0u);
    }
    return textureLoad(vertices, storage_texel(3u * primitive + 2u), 0);
}

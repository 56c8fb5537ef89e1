// The texture atlas: all images in an array of pages, with glTF's wrap modes. A texture's place is (x | y << 16,
// width | height << 16, page | wrap_s << 11 | wrap_t << 13 | page of the levels << 15 | TEXTURE_* flags, x | y <<
// 16 of the levels).

// The pages as sRGB, decoded on reading.
var atlas_color: texture_2d_array<f32>;
// The same pages without decoding.
var atlas_data: texture_2d_array<f32>;

// A rectangle of texels on a page of the atlas.
struct Texels {
    corner: vec2i,
    size: vec2i,
    page: i32,
    nearest: bool,
}

// Maps a coordinate into [0, 1] by its wrap mode.
fn texture_fold_axis(x: f32, wrap: u32) -> f32 {
    let repeated = x - floor(x);
    let mirrored = 1.0 - abs(1.0 - 2.0 * (0.5 * x - floor(0.5 * x)));
    let clamped = clamp(x, 0.0, 1.0);
    return select(select(clamped, mirrored, wrap == WRAP_MIRROR), repeated, wrap == WRAP_REPEAT);
}

// Wraps a texel index. Folded coordinates are at most one texel outside the image (two with weight zero), so no
// division is needed.
fn texture_wrap_axis(i: i32, size: i32, wrap: u32) -> i32 {
    let repeated = select(select(i, i - size, i >= size), i + size, i < 0);
    return select(clamp(i, 0, size - 1), repeated, wrap == WRAP_REPEAT);
}

// Wrap modes of s and t, from the third word of a place.
fn texture_wrap(word: u32) -> vec2u {
    return vec2u((word >> 11u) & 3u, (word >> 13u) & 3u);
}

fn texture_corner(word: u32) -> vec2i {
    return vec2i(vec2u(word & 0xffffu, word >> 16u));
}

// The rectangle of the image at full resolution.
fn texture_whole(place: vec4u) -> Texels {
    let nearest = (place.z & TEXTURE_NEAREST) != 0u;
    return Texels(texture_corner(place.x), texture_corner(place.y), i32(place.z & TEXTURE_PAGE), nearest);
}

// Samples a texture at one point, nearest or bilinear.
fn texture_point(atlas: texture_2d_array<f32>, t: Texels, wrap: vec2u, texcoord: vec2f) -> vec4f {
    let folded = vec2f(texture_fold_axis(texcoord.x, wrap.x), texture_fold_axis(texcoord.y, wrap.y));
    let at = folded * vec2f(t.size) - 0.5;
    let floored = vec2i(floor(select(at, at + 0.5, t.nearest)));
    let weight = select(at - floor(at), vec2f(0.0), t.nearest);
    let low = t.corner + vec2i(texture_wrap_axis(floored.x, t.size.x, wrap.x), texture_wrap_axis(floored.y, t.size.y, wrap.y));
    let high = t.corner
        + vec2i(texture_wrap_axis(floored.x + 1, t.size.x, wrap.x), texture_wrap_axis(floored.y + 1, t.size.y, wrap.y));
    let top = mix(textureLoad(atlas, low, t.page, 0), textureLoad(atlas, vec2i(high.x, low.y), t.page, 0), weight.x);
    let bottom = mix(textureLoad(atlas, vec2i(low.x, high.y), t.page, 0), textureLoad(atlas, high, t.page, 0), weight.x);
    return mix(top, bottom, weight.y);
}

fn texture_present(place: vec4u) -> bool {
    return (place.z & TEXTURE_PRESENT) != 0u;
}

// Whether the point is part of the surface: alpha is tested at the point, never averaged.
fn texture_alpha(place: vec4u, texcoord: vec2f) -> f32 {
    if !texture_present(place) {
        return 1.0;
    }
    return texture_point(atlas_color, texture_whole(place), texture_wrap(place.z), texcoord).a;
}

// The first texture of a material, which determines how texture coordinates are stored.
fn texture_first(object: u32) -> u32 {
    let base = object_at(object).base_color_texture.z;
    let metallic_roughness = object_at(object).metallic_roughness_texture.z;
    let others = select(object_at(object).emissive_texture.z, metallic_roughness, (metallic_roughness & TEXTURE_PRESENT) != 0u);
    return select(others, base, (base & TEXTURE_PRESENT) != 0u);
}

fn texture_fold(object: u32, texcoord: vec2f) -> vec2f {
    let wrap = texture_wrap(texture_first(object));
    return vec2f(texture_fold_axis(texcoord.x, wrap.x), texture_fold_axis(texcoord.y, wrap.y));
}

fn texture_seam_matters(object: u32) -> bool {
    return (texture_first(object) & TEXTURE_PRESENT) != 0u;
}

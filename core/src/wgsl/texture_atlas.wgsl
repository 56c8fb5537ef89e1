// All images in one array of pages, filtered bilinearly with glTF's wrap modes. A place is
// (x | y << 16, width | height << 16, page | wrap_s << 16 | wrap_t << 18 | TEXTURE_* flags).

// Decodes sRGB.
var atlas_color: texture_2d_array<f32>;
// The same texels as they are.
var atlas_data: texture_2d_array<f32>;

struct Footprint {
    low: vec2i,
    high: vec2i,
    weight: vec2f,
    page: i32,
}

// The coordinate inside [0, 1] that shows the same texel.
fn texture_fold_axis(x: f32, wrap: u32) -> f32 {
    let repeated = x - floor(x);
    let mirrored = 1.0 - abs(1.0 - 2.0 * (0.5 * x - floor(0.5 * x)));
    let clamped = clamp(x, 0.0, 1.0);
    return select(select(clamped, mirrored, wrap == WRAP_MIRROR), repeated, wrap == WRAP_REPEAT);
}

// Folded coordinates lead at most one texel beside the image (two where its weight is zero): no division is needed.
fn texture_wrap_axis(i: i32, size: i32, wrap: u32) -> i32 {
    let repeated = select(select(i, i - size, i >= size), i + size, i < 0);
    return select(clamp(i, 0, size - 1), repeated, wrap == WRAP_REPEAT);
}

fn texture_footprint(place: vec3u, texcoord: vec2f) -> Footprint {
    let corner = vec2i(vec2u(place.x & 0xffffu, place.x >> 16u));
    let size = vec2i(vec2u(place.y & 0xffffu, place.y >> 16u));
    let wrap = vec2u((place.z >> 16u) & 3u, (place.z >> 18u) & 3u);
    let folded = vec2f(texture_fold_axis(texcoord.x, wrap.x), texture_fold_axis(texcoord.y, wrap.y));
    let at = folded * vec2f(size) - 0.5;
    let nearest = (place.z & TEXTURE_NEAREST) != 0u;
    let low = vec2i(floor(select(at, at + 0.5, nearest)));
    var f: Footprint;
    f.weight = select(at - floor(at), vec2f(0.0), nearest);
    f.low = corner + vec2i(texture_wrap_axis(low.x, size.x, wrap.x), texture_wrap_axis(low.y, size.y, wrap.y));
    f.high = corner + vec2i(texture_wrap_axis(low.x + 1, size.x, wrap.x), texture_wrap_axis(low.y + 1, size.y, wrap.y));
    f.page = i32(place.z & 0xffffu);
    return f;
}

fn texture_color(place: vec3u, texcoord: vec2f) -> vec4f {
    if (place.z & TEXTURE_PRESENT) == 0u {
        return vec4f(1.0);
    }
    let f = texture_footprint(place, texcoord);
    let top = mix(textureLoad(atlas_color, f.low, f.page, 0), textureLoad(atlas_color, vec2i(f.high.x, f.low.y), f.page, 0), f.weight.x);
    let bottom = mix(textureLoad(atlas_color, vec2i(f.low.x, f.high.y), f.page, 0), textureLoad(atlas_color, f.high, f.page, 0), f.weight.x);
    return mix(top, bottom, f.weight.y);
}

fn texture_data(place: vec3u, texcoord: vec2f) -> vec4f {
    if (place.z & TEXTURE_PRESENT) == 0u {
        return vec4f(1.0);
    }
    let f = texture_footprint(place, texcoord);
    let top = mix(textureLoad(atlas_data, f.low, f.page, 0), textureLoad(atlas_data, vec2i(f.high.x, f.low.y), f.page, 0), f.weight.x);
    let bottom = mix(textureLoad(atlas_data, vec2i(f.low.x, f.high.y), f.page, 0), textureLoad(atlas_data, f.high, f.page, 0), f.weight.x);
    return mix(top, bottom, f.weight.y);
}

// Of several textures of a material the first that is there decides how coordinates are stored.
fn texture_first(object: u32) -> u32 {
    let base = objects[object].base_color_texture.z;
    let metallic_roughness = objects[object].metallic_roughness_texture.z;
    let others = select(objects[object].emissive_texture.z, metallic_roughness, (metallic_roughness & TEXTURE_PRESENT) != 0u);
    return select(others, base, (base & TEXTURE_PRESENT) != 0u);
}

fn texture_fold(object: u32, texcoord: vec2f) -> vec2f {
    let place = texture_first(object);
    return vec2f(
        texture_fold_axis(texcoord.x, (place >> 16u) & 3u),
        texture_fold_axis(texcoord.y, (place >> 18u) & 3u),
    );
}

fn texture_seam_matters(object: u32) -> bool {
    return (texture_first(object) & TEXTURE_PRESENT) != 0u;
}

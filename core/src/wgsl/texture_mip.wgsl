// Textures with mip levels: the average over a footprint, an ellipse in texture coordinates with the second moments
// (ss, tt, st) of its axes. It is sampled by points of two levels along its longer axis (after McCormack et al. 1999,
// "Feline"), whose weights cover a length r in units of their distance and so change smoothly with it.
//
// Level and length are such that the second moment is that of the average which many samples of the image itself
// converge to. With texels s wide in a level, an average over the footprint's axis w and the bilinear filters on both sides:
//   2 + w^2 = (s^2 - 1) + 2 s^2 + (r^2 - 1) s^2, in texels of the image,
// where r = 1 along the shorter axis gives s^2 = 1 + w^2 / 3. One is taken off w^2: what is magnified is the image as it is.

struct Average {
    // log2 s
    level: f32,
    // r
    length: f32,
    // From point to point, in texture coordinates.
    step: vec2f,
}

// A level from 1 on.
fn texture_level(place: vec4u, level: u32) -> Texels {
    let size = texture_corner(place.y);
    var corner = texture_corner(place.w);
    if level > 1u {
        corner.x += max(size.x >> 1u, 1);
        for (var above = 2u; above < level; above += 1u) {
            corner.y += max(size.y >> above, 1);
        }
    }
    return Texels(corner, max(size >> vec2u(level), vec2i(1)), i32((place.z >> 15u) & TEXTURE_PAGE), false);
}

fn texture_average(atlas: texture_2d_array<f32>, place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    let size = vec2f(texture_corner(place.y));
    let e = footprint * vec3f(size * size, size.x * size.y);
    let middle = 0.5 * (e.x + e.y);
    let half_difference = 0.5 * (e.x - e.y);
    let spread = sqrt(half_difference * half_difference + e.z * e.z);
    if middle + spread <= 1.0 {
        return texture_point(atlas, texture_whole(place), texture_wrap(place.z), texcoord);
    }
    let long = middle + spread - 1.0;
    let short = max(middle - spread - 1.0, 0.0);
    let s2 = max(1.0 + short / 3.0, (long + 3.0) / (TEXTURE_MOST_LENGTH * TEXTURE_MOST_LENGTH + 2.0));
    let along = select(vec2f(e.z, spread - half_difference), vec2f(spread + half_difference, e.z), half_difference >= 0.0);
    let direction = along * inverseSqrt(max(dot(along, along), 1.0e-30));
    let smallest = f32(firstLeadingBit(max(u32(size.x), u32(size.y))));
    let average = Average(
        min(0.5 * log2(s2), smallest),
        sqrt(max((long + 3.0) / s2 - 2.0, 1.0)),
        direction * sqrt(s2) / size,
    );
    let level = u32(average.level);
    // glTF's nearest texel is for what is magnified.
    var t = texture_whole(place);
    t.nearest = false;
    if level > 0u {
        t = texture_level(place, level);
    }
    let finer = texture_along(atlas, t, texture_wrap(place.z), texcoord, average);
    let part = average.level - f32(level);
    if part == 0.0 {
        return finer;
    }
    let coarser = texture_along(atlas, texture_level(place, level + 1u), texture_wrap(place.z), texcoord, average);
    return mix(finer, coarser, part);
}

fn texture_along(atlas: texture_2d_array<f32>, t: Texels, wrap: vec2u, texcoord: vec2f, average: Average) -> vec4f {
    var sum = texture_point(atlas, t, wrap, texcoord);
    for (var i = 1.0; i < 0.5 * average.length + 0.5; i += 1.0) {
        let offset = i * average.step;
        let weight = min(0.5 * average.length + 0.5 - i, 1.0);
        sum += weight * (texture_point(atlas, t, wrap, texcoord - offset) + texture_point(atlas, t, wrap, texcoord + offset));
    }
    return sum / average.length;
}

fn texture_color(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    if !texture_present(place) {
        return vec4f(1.0);
    }
    return texture_average(atlas_color, place, texcoord, footprint);
}

fn texture_data(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    if !texture_present(place) {
        return vec4f(1.0);
    }
    return texture_average(atlas_data, place, texcoord, footprint);
}

// -1 where exactly one of the coordinates is folded back, so that the footprint leans the other way.
fn texture_fold_sign(object: u32, texcoord: vec2f) -> f32 {
    let odd = abs(floor(texcoord) - 2.0 * floor(0.5 * texcoord)) == vec2f(1.0);
    let back = odd & (texture_wrap(texture_first(object)) == vec2u(WRAP_MIRROR));
    return select(1.0, -1.0, back.x != back.y);
}

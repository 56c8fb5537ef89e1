// Texture lookups with mip levels: the average over a footprint, an ellipse in texture coordinates given by the
// second moments (ss, tt, st) of its axes. It is approximated by points of one level along both axes (along the
// longer one as in McCormack et al. 1999, "Feline"), one texel of the level apart. Their weights cover a length r
// in units of this distance and change continuously with it, which comes closer to a box average over a pixel
// than a single wide texel.
//
// The lengths are chosen so that second moments match those of the average that many samples of the image would
// converge to. For a level with texels s wide, a footprint axis w and the bilinear filters on both sides:
//   2 + w^2 = (s^2 - 1) + 2 s^2 + (r^2 - 1) s^2, in texels of the image,
// so r^2 = (w^2 + 3) / s^2 - 2, and one point suffices for s^2 = 1 + w^2 / 3; the level is the next finer one. 1
// is subtracted from w^2 so that magnified textures are shown unfiltered.

// The footprint's ellipse in texels of the image.
struct Ellipse {
    // Direction of the longer axis.
    direction: vec2f,
    // w^2 along the longer and the shorter axis.
    axes: vec2f,
}

// The rectangle of a mip level, from 1 on.
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
    let along = select(vec2f(e.z, spread - half_difference), vec2f(spread + half_difference, e.z), half_difference >= 0.0);
    let ellipse = Ellipse(along * inverseSqrt(max(dot(along, along), 1.0e-30)), vec2f(long, short));
    let s2 = max(1.0 + short / 3.0, (long + 3.0) / (TEXTURE_MOST_LENGTH * TEXTURE_MOST_LENGTH + 2.0));
    let smallest = f32(firstLeadingBit(max(u32(size.x), u32(size.y))));
    let level = min(0.5 * log2(s2), smallest);
    let below = u32(level);
    let finer = texture_points(atlas, place, below, texcoord, ellipse);
    // Blends two levels to avoid visible seams.
    let part = 1.0 - TEXTURE_STEPS * (f32(below + 1u) - level);
    if part <= 0.0 {
        return finer;
    }
    return mix(finer, texture_points(atlas, place, below + 1u, texcoord, ellipse), part);
}

fn texture_points(atlas: texture_2d_array<f32>, place: vec4u, level: u32, texcoord: vec2f, ellipse: Ellipse) -> vec4f {
    // Nearest filtering (glTF) applies to magnification only.
    var t = texture_whole(place);
    t.nearest = false;
    if level > 0u {
        t = texture_level(place, level);
    }
    let wrap = texture_wrap(place.z);
    let side = exp2(f32(level));
    let lengths = sqrt(clamp((ellipse.axes + 3.0) / (side * side) - 2.0, vec2f(1.0), vec2f(TEXTURE_LONGEST, TEXTURE_WIDEST)));
    let step = side / vec2f(texture_corner(place.y));
    let column = ellipse.direction * step;
    let row = vec2f(-ellipse.direction.y, ellipse.direction.x) * step;
    let last = ceil(0.5 * lengths - 0.5);
    var sum = vec4f(0.0);
    for (var j = -last.y; j <= last.y; j += 1.0) {
        for (var i = -last.x; i <= last.x; i += 1.0) {
            let weights = min(0.5 * lengths + 0.5 - abs(vec2f(i, j)), vec2f(1.0));
            sum += weights.x * weights.y * texture_point(atlas, t, wrap, texcoord + i * column + j * row);
        }
    }
    return sum / (lengths.x * lengths.y);
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

// -1 if exactly one of the coordinates is mirrored, which flips the footprint's correlation; else 1.
fn texture_fold_sign(object: u32, texcoord: vec2f) -> f32 {
    let odd = abs(floor(texcoord) - 2.0 * floor(0.5 * texcoord)) == vec2f(1.0);
    let back = odd & (texture_wrap(texture_first(object)) == vec2u(WRAP_MIRROR));
    return select(1.0, -1.0, back.x != back.y);
}

// Reprojection: pixels that something was moved to show it again. Listed, to be traced, are gaps, pixels that a farther
// surface may show through a gap of a nearer one, those whose turn it is, and those where it matters that what was moved
// lies beside the centre of the pixel.

struct Splat {
    key: u32,
    source: u32,
}

var<storage, read> splats: array<Splat>;

// A pixel is suspected where what is on both sides of it is nearer than this share of its depth.
const REUSE_NEARER: f32 = 0.96875;

fn reuse_depth(pixel: vec2i) -> f32 {
    if any(pixel < vec2i(0)) || any(pixel >= vec2i(frame.size)) {
        return FAR;
    }
    let key = splats[u32(pixel.y) * frame.size.x + u32(pixel.x)].key;
    return select(bitcast<f32>(~key >> 1u), FAR, key == 0u);
}

// Does the pixel lie between nearer ones? Gaps of a surface that comes closer are lines of one pixel, and where two of
// them cross only the corners are of the surface.
fn reuse_is_gap(pixel: vec2u) -> bool {
    let middle = vec2i(pixel);
    let limit = REUSE_NEARER * reuse_depth(middle);
    for (var side = 0; side < 4; side += 1) {
        let step = select(vec2i(side - 2, 1), vec2i(1, 0), side == 0);
        if max(reuse_depth(middle - step), reuse_depth(middle + step)) < limit {
            return true;
        }
    }
    return false;
}

// A pixel is traced where the way from its centre to its point takes more than this of the contrast to a neighbour's
// point on the other side, in roots of radiance.
const REUSE_ERROR: f32 = 0.0625;

struct Recentred {
    radiance: vec3f,
    error: f32,
}

// The radiance in the centre of a pixel, from its own point and those of the three pixels on the other side of the centre,
// and how wrong it may be.
fn reuse_centred(pixel: vec2u, source: u32) -> Recentred {
    let centre = vec2f(pixel) + 0.5;
    let aside = frame_place(history_point(source)) - centre;
    let across = select(vec2i(1), vec2i(-1), aside > vec2f(0.0));
    let own = history_radiance(source);
    var weight = reuse_weight(aside);
    var centred = Recentred(weight * own, 0.0);
    for (var side = 1; side < 4; side += 1) {
        let neighbour = vec2i(pixel) + across * (vec2i(side, side >> 1u) & vec2i(1));
        if any(neighbour < vec2i(0)) || any(neighbour >= vec2i(frame.size)) {
            continue;
        }
        let other = splats[u32(neighbour.y) * frame.size.x + u32(neighbour.x)].source;
        if other == 0u {
            continue;
        }
        let beyond = frame_place(history_point(~other)) - centre;
        let radiance = history_radiance(~other);
        let contrast = abs(sqrt(max(radiance, vec3f(0.0))) - sqrt(max(own, vec3f(0.0))));
        let way = length(aside) / max(length(beyond - aside), 0.25);
        centred.error = max(centred.error, way * max(contrast.x, max(contrast.y, contrast.z)));
        let share = reuse_weight(beyond);
        weight += share;
        centred.radiance += share * radiance;
    }
    centred.radiance /= weight;
    return centred;
}

// How much of what is seen so far from the centre of a pixel counts in it.
fn reuse_weight(aside: vec2f) -> f32 {
    let near = max(1.0 - abs(aside), vec2f(0.0));
    return near.x * near.y;
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let place = pixel.y * frame.size.x + pixel.x;
    if refresh_is_due(pixel) {
        list_append(pixel);
        return;
    }
    if frame.still != 0u {
        // The picture has it.
        history_store(pixel, history_point(place), history_radiance(place));
        inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
        return;
    }
    let splat = splats[place];
    if splat.source == 0u || reuse_is_gap(pixel) {
        list_append(pixel);
        return;
    }
    let centred = reuse_centred(pixel, ~splat.source);
    if centred.error > REUSE_ERROR {
        list_append(pixel);
        return;
    }
    // What is kept is not blurred again and again.
    history_store(pixel, history_point(~splat.source), history_radiance(~splat.source));
    output(pixel, centred.radiance);
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
}

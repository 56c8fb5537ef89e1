// Reprojection: shows pixels again that a point was projected to. Lists for tracing gaps, pixels that may show a
// farther surface through a gap in a nearer one, pixels that are due, and those where the point's offset from the
// pixel's centre would be visible.

struct Splat {
    key: u32,
    source: u32,
}

var<storage, read> splats: array<Splat>;

// A pixel may be a gap where the pixels on both sides of it are nearer than this fraction of its depth.
const REUSE_NEARER: f32 = 0.96875;

fn reuse_depth(pixel: vec2i) -> f32 {
    if any(pixel < vec2i(0)) || any(pixel >= vec2i(frame.size)) {
        return FAR;
    }
    let key = splats[u32(pixel.y) * frame.size.x + u32(pixel.x)].key;
    return select(bitcast<f32>(~key >> 1u), FAR, key == 0u);
}

// Whether the pixel lies between nearer ones. Gaps in an approaching surface are lines one pixel wide; where two
// of them cross, only the diagonal neighbours belong to the surface.
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

// A pixel is traced if the offset of its point covers more than this share of the contrast to a neighbour's point
// on the other side, in square roots of radiance.
const REUSE_ERROR: f32 = 0.0625;

struct Recentred {
    radiance: vec3f,
    error: f32,
}

// Radiance at the pixel's centre, interpolated from its own point and those of the three pixels on the other side
// of the centre, with an estimate of the error.
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

// Bilinear weight of a point by its offset from the pixel's centre, in pixels.
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
        // The image already shows the pixel.
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
    // The stored radiance stays uninterpolated, so that blur does not accumulate.
    history_store(pixel, history_point(~splat.source), history_radiance(~splat.source));
    output(pixel, centred.radiance);
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
}

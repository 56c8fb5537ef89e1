// Reprojection: pixels that something was moved to show it again. Listed, to be traced, are gaps, pixels that a farther
// surface may show through a gap of a nearer one, and those whose turn it is.

struct Landing {
    key: u32,
    source: u32,
}

var<storage, read> landed: array<Landing>;

// A pixel is suspected where what is on both sides of it is nearer than this share of its depth.
const REUSE_NEARER: f32 = 0.96875;

fn reuse_depth(pixel: vec2i) -> f32 {
    if any(pixel < vec2i(0)) || any(pixel >= vec2i(frame.size)) {
        return FAR;
    }
    let key = landed[u32(pixel.y) * frame.size.x + u32(pixel.x)].key;
    return select(bitcast<f32>(~key >> 1u), FAR, key == 0u);
}

// Does the pixel lie between nearer ones? Gaps of a surface that comes closer are lines of one pixel, and where two of
// them cross only the corners are of the surface.
fn reuse_shows_through(pixel: vec2u) -> bool {
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

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.first)) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    var source = pixel.y * frame.size.x + pixel.x;
    var lost = renewal_is_due(pixel);
    if !lost && frame.still == 0u {
        let landing = landed[source];
        lost = landing.source == 0u || reuse_shows_through(pixel);
        source = ~landing.source;
    }
    if lost {
        list_append(pixel);
        return;
    }
    let radiance = history_radiance(source);
    history_store(pixel, history_point(source), radiance);
    output(pixel, radiance);
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
}

// Projects the surface points of the last frame into the current view.

struct Splat {
    // Greatest depth key of the points in the pixel, 0 if there are none.
    key: atomic<u32>,
    // First pixel of the last frame with this key, bits inverted.
    source: atomic<u32>,
}

var<storage, read_write> splats: array<Splat>;

// Pixel and depth key of a reprojected point.
struct Reprojected {
    to: u32,
    // Key of the depth test; 0 if the point is outside the frame.
    key: u32,
}

// Number of the lowest bits of a key, which encode the distance from the pixel's centre.
const REPROJECT_OFFSET_BITS: u32 = 13u;

// Reprojects a pixel. Keys are greater for nearer points; among depths that agree to one part in 2^11, hence of
// one surface, for the point nearer to the pixel's centre.
fn reproject_point(pixel: vec2u) -> Reprojected {
    let point = history_point(pixel.y * frame.size.x + pixel.x);
    if point.x == FAR {
        return Reprojected(0u, 0u);
    }
    let at = frame_place(point);
    if !(all(at >= vec2f(0.0)) && all(at < vec2f(frame.size))) {
        return Reprojected(0u, 0u);
    }
    let depth = dot(point - frame.camera.origin, frame.camera.forward);
    let aside = fract(at) - 0.5;
    let offset = u32(dot(aside, aside) * f32((2u << REPROJECT_OFFSET_BITS) - 2u));
    // Depths are positive: the sign bit is shifted out of the key.
    let order = (bitcast<u32>(depth) << 1u) & ~((1u << REPROJECT_OFFSET_BITS) - 1u);
    let to = vec2u(at);
    return Reprojected(to.y * frame.size.x + to.x, ~(order | min(offset, (1u << REPROJECT_OFFSET_BITS) - 1u)));
}

// Whether the camera has moved since the last frame.
fn reproject_is_needed() -> bool {
    return frame.refresh_count < RANKS && frame.still == 0u;
}

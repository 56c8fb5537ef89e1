// Projects the surface points of the previous frame into the present one.

struct Splat {
    // The greatest key of what landed in the pixel, 0 where nothing did.
    key: atomic<u32>,
    // The first pixel of the frame before that has this key, its bits inverted.
    source: atomic<u32>,
}

var<storage, read_write> splats: array<Splat>;

// Target of a pixel of the previous frame.
struct Reprojected {
    to: u32,
    // Key of the depth test; 0 where the point is outside of the frame.
    key: u32,
}

// Of this many bits of a key's 32 the lowest tell how near to the centre of the pixel.
const REPROJECT_OFFSET_BITS: u32 = 13u;

// The key is greater for the nearer of two points (closest depth wins); of points that are as far to a part in 2^11, which
// are of one surface, for the one that is nearer to the centre of the pixel.
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

// Whether the camera has moved since the previous frame.
fn reproject_is_needed() -> bool {
    return frame.refresh_count < RANKS && frame.still == 0u;
}

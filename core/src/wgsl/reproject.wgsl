// Projects the surface points of the previous frame into the present one.

struct Landed {
    // The greatest key of what landed in the pixel, 0 where nothing did.
    key: atomic<u32>,
    // The first pixel of the frame before that has this key, its bits inverted.
    source: atomic<u32>,
}

var<storage, read_write> landed: array<Landed>;

// Target of a pixel of the previous frame.
struct Move {
    to: u32,
    // Key of the depth test; 0 where the point is outside of the frame.
    key: u32,
}

// Of this many bits of a key's 32 the lowest tell how near to the centre of the pixel.
const MOVE_OFFSET_BITS: u32 = 13u;

// The key is greater for the nearer of two points (closest depth wins); of points that are as far to a part in 2^11, which
// are of one surface, for the one that is nearer to the centre of the pixel.
fn reproject_move(pixel: vec2u) -> Move {
    let point = history_point(pixel.y * frame.size.x + pixel.x);
    if point.x == FAR {
        return Move(0u, 0u);
    }
    let at = frame_place(point);
    if !(all(at >= vec2f(0.0)) && all(at < vec2f(frame.size))) {
        return Move(0u, 0u);
    }
    let depth = dot(point - frame.camera.origin, frame.camera.forward);
    let aside = fract(at) - 0.5;
    let offset = u32(dot(aside, aside) * f32((2u << MOVE_OFFSET_BITS) - 2u));
    // Depths are positive: the sign bit is shifted out of the key.
    let order = (bitcast<u32>(depth) << 1u) & ~((1u << MOVE_OFFSET_BITS) - 1u);
    let to = vec2u(at);
    return Move(to.y * frame.size.x + to.x, ~(order | min(offset, (1u << MOVE_OFFSET_BITS) - 1u)));
}

// Whether the camera has moved since the previous frame.
fn reproject_needed() -> bool {
    return frame.renewed < RANKS && frame.still == 0u;
}

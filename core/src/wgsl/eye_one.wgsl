// The frame is what one eye sees.

fn eye_same(a: vec2u, b: vec2u) -> bool {
    return true;
}

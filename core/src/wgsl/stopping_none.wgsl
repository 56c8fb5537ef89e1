// Paths go on wherever the eyes look.

fn stopping_stops(pixel: vec2u, number: f32) -> bool {
    return false;
}

fn stopping_weight(pixel: vec2u) -> f32 {
    return 1.0;
}

// For frames without gaze-based stopping: paths go on everywhere in the picture.

fn stopping_stops(pixel: vec2u, number: f32) -> bool {
    return false;
}

fn stopping_weight(pixel: vec2u) -> f32 {
    return 1.0;
}

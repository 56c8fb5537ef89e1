// For frames without foveation: no path is stopped by its distance from the gaze.

fn foveation_terminates(pixel: vec2u, number: f32) -> bool {
    return false;
}

fn foveation_weight(pixel: vec2u) -> f32 {
    return 1.0;
}

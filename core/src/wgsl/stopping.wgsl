// Paths stop away from the gaze, with a probability that grows with the distance (Kim & Sung 2021, equation 7).

fn stopping_stops(pixel: vec2u, number: f32) -> bool {
    return number < stopping_probability(pixel);
}

// Weight of a path that was not stopped.
fn stopping_weight(pixel: vec2u) -> f32 {
    if !STOPPING_COMPENSATED {
        return 1.0;
    }
    return 1.0 / (1.0 - stopping_probability(pixel));
}

fn stopping_probability(pixel: vec2u) -> f32 {
    return frame.paths.stop * distance(vec2f(eyes_pixel(pixel)) + 0.5, frame.paths.gaze);
}

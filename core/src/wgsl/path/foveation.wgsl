// Foveation: paths stop with a probability that grows with the distance from the gaze (Kim & Sung 2021, equation
// 7).

fn foveation_terminates(pixel: vec2u, number: f32) -> bool {
    return number < foveation_probability(pixel);
}

// Weight of a path that was not stopped.
fn foveation_weight(pixel: vec2u) -> f32 {
    if !FOVEATION_COMPENSATED {
        return 1.0;
    }
    return 1.0 / (1.0 - foveation_probability(pixel));
}

fn foveation_probability(pixel: vec2u) -> f32 {
    return frame.paths.stop * distance(vec2f(eyes_pixel(pixel)) + 0.5, frame.paths.gaze);
}

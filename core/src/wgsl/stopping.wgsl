// Paths stop away from the gaze, with a probability that grows with the distance (Kim & Sung 2021, equation 7).

fn stopping_stops(pixel: vec2u, number: f32) -> bool {
    return number < stopping_probability(pixel);
}

// What a path counts for that has gone on.
fn stopping_weight(pixel: vec2u) -> f32 {
    if !STOPPING_COMPENSATED {
        return 1.0;
    }
    return 1.0 / (1.0 - stopping_probability(pixel));
}

// The share of samples at which the other eye looks: as many as go on in the middle of a tile of 8x8 pixels.
fn stopping_looks(pixel: vec2u) -> f32 {
    return max(1.0 - stopping_probability(pixel / 8u * 8u + 4u), 0.0);
}

fn stopping_probability(pixel: vec2u) -> f32 {
    return frame.stop * distance(vec2f(eyes_pixel(pixel)) + 0.5, frame.gaze);
}

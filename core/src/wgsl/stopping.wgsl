// Paths stop away from the gaze, with a probability that grows with the distance (Kim & Sung 2021, equation 7). Where
// the others count for more, they stop before the lights of the surface instead of behind them: two thirds of its rays.

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

// The other eye looks at samples of the rows in which fewer paths than that stop below and above the gaze.
const STOPPING_LOOKS: f32 = 0.25;

fn stopping_looks(row: u32) -> bool {
    return frame.stop * abs(f32(row) + 0.5 - frame.gaze.y) < STOPPING_LOOKS;
}

fn stopping_probability(pixel: vec2u) -> f32 {
    return frame.stop * distance(vec2f(eyes_pixel(pixel)) + 0.5, frame.gaze);
}

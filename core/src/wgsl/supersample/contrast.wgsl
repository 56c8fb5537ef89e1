// How much colours differ (Mitchell 1987, as Jin 2009, 4.2.2, scales it). Deviations: contrasts are of square roots of
// radiances up to 1, which is about how they are shown; where the darkest and the brightest sum to less than 1, their
// difference counts instead, for the contrast of what is nearly black is that of its last digits.

const CONTRAST_SCALE: vec3f = vec3f(1.36, 1.02, 2.04);

fn contrast_shown(color: vec3f) -> vec3f {
    return sqrt(clamp(color, vec3f(0.0), vec3f(1.0)));
}

// Of the darkest and the brightest as they are shown; a threshold of 0 is always reached, one of 1 never.
fn contrast_exceeds(low: vec3f, high: vec3f, tau: f32) -> bool {
    let contrast = (high - low) / max(high + low, vec3f(1.0));
    return any(contrast >= tau * CONTRAST_SCALE);
}

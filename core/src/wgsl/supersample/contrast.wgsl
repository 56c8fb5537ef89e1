// Contrast of colours (Mitchell 1987, scaled as in Jin 2009, 4.2.2). Deviations: contrasts are of square roots of
// radiances up to 1, which approximates display encoding. If the least and the greatest value sum to less than 1,
// their difference is used instead, as the contrast of nearly black colours is rounding noise.

const CONTRAST_SCALE: vec3f = vec3f(1.36, 1.02, 2.04);

fn contrast_shown(color: vec3f) -> vec3f {
    return sqrt(clamp(color, vec3f(0.0), vec3f(1.0)));
}

// Whether the contrast of display-encoded colours exceeds a threshold; 0 is always exceeded, 1 never.
fn contrast_exceeds(low: vec3f, high: vec3f, tau: f32) -> bool {
    let contrast = (high - low) / max(high + low, vec3f(1.0));
    return any(contrast >= tau * CONTRAST_SCALE);
}

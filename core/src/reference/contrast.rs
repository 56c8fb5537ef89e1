//! Contrast of colours (Mitchell 1987, scaled as in Jin 2009, 4.2.2).

use glam::DVec3;

/// Factors of the threshold for the red, green and blue contrast (Jin 2009, 4.2).
const SCALE: [f64; 3] = [1.36, 1.02, 2.04];

/// Contrast of red, green and blue between approximately display-encoded colours; between dark colours, the
/// difference.
pub(super) fn contrasts(colors: impl Iterator<Item = DVec3>) -> [f64; 3] {
    let shown = colors.map(shown);
    let (low, high) = shown.fold((DVec3::INFINITY, DVec3::ZERO), |(low, high), c| (low.min(c), high.max(c)));
    [0, 1, 2].map(|i| (high[i] - low[i]) / (high[i] + low[i]).max(1.0))
}

/// Encodes linear radiance with gamma 2, an approximation of the display's curve.
pub(super) fn shown(color: DVec3) -> DVec3 {
    color.clamp(DVec3::ZERO, DVec3::ONE).map(f64::sqrt)
}

/// Whether any channel reaches the threshold.
pub(super) fn exceeds(contrasts: [f64; 3], tau: f64) -> bool {
    (0..3).any(|i| contrasts[i] >= tau * SCALE[i])
}

//! Converts thermal headroom into a share of the frame time.

/// Headroom below which all of the frame time may be used. At 1 the system begins severe throttling
/// (`AThermal_getThermalHeadroom`).
const COOL: f32 = 0.75;

/// The share at a headroom of 1.
const AT_LIMIT: f32 = 0.5;

/// The least share, beyond a headroom of 1.
const LEAST: f32 = 0.25;

/// The share of the frame time that may be used at a forecast headroom: 1 while the device is cool, then linearly less,
/// so that the system does not have to throttle suddenly. 1 where the headroom is NaN, which means unknown.
pub fn share(headroom: f32) -> f32 {
    if headroom.is_nan() {
        return 1.0;
    }
    let slope = (1.0 - AT_LIMIT) / (1.0 - COOL);
    (1.0 - slope * (headroom - COOL).max(0.0)).clamp(LEAST, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_takes_time_away_by_and_by() {
        let shares = [0.0, 0.75, 0.875, 1.0, 1.125, 9.0, f32::INFINITY].map(share);
        assert_eq!(shares, [1.0, 1.0, 0.75, 0.5, 0.25, 0.25, 0.25]);
        assert_eq!(share(f32::NAN), 1.0);
        assert_eq!(share(-1.0), 1.0);
    }
}

//! How hot the device is, as the time that a frame may take.

/// Below this headroom nothing is spared. 1 is where the system begins to throttle severely
/// (`AThermal_getThermalHeadroom`).
const COOL: f32 = 0.75;

/// At the system's own limit a frame may take so much of its time.
const AT_LIMIT: f32 = 0.5;

/// What a device beyond its limit is left with.
const LEAST: f32 = 0.25;

/// The share of a frame's time that may be used at a forecast headroom: all while the device is cool, then less by a
/// straight line, so that the system never has to take it away in a step. Nothing is known where the headroom is NaN.
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

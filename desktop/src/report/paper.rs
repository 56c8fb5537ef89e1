//! The tables of Kim, Seo, Kim, Lim, Nah, Ihm, "Adaptive Undersampling for Efficient Mobile Ray Tracing", The Visual
//! Computer 32, 2016 (Adreno 420; table 4: AMD Radeon R9 Fury X), as printed.

/// How the tables are cited.
pub const CITATION: &str = "Kim, Seo, Kim, Lim, Nah, Ihm, \"Adaptive Undersampling for Efficient Mobile Ray Tracing\", \
                            The Visual Computer 32, 2016";

/// Full and adaptive time of one frame, and what the latter is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Samples along a side of a pixel.
    pub sampling: u32,
    /// Full ray tracing, milliseconds.
    pub full_ms: f64,
    /// Theirs, milliseconds.
    pub ours_ms: f64,
    /// Traced samples over all samples.
    pub rt_ratio: f64,
    /// Decibels against full ray tracing of the same sampling.
    pub psnr_db: f64,
}

const fn pair(sampling: u32, full_ms: f64, ours_ms: f64, rt_ratio: f64, psnr_db: f64) -> Pair {
    Pair { sampling, full_ms, ours_ms, rt_ratio, psnr_db }
}

/// The side of a square frame, and three rates of sampling.
pub type Size = (u32, [Pair; 3]);

/// Table 5: scene, triangles, and three sizes.
#[rustfmt::skip]
#[allow(clippy::approx_constant, reason = "0.318 is a ratio of rays")]
pub const TABLE_5: [(&str, u32, [Size; 3]); 6] = [
    ("Café", 29_359, [
        (512, [pair(1, 314.0, 199.3, 0.327, 43.44), pair(2, 1203.1, 637.3, 0.294, 41.72), pair(4, 4620.6, 2130.1, 0.274, 41.68)]),
        (1024, [pair(1, 1211.7, 591.2, 0.294, 43.99), pair(2, 4396.7, 2079.5, 0.274, 44.03), pair(4, 16663.8, 7382.3, 0.263, 44.26)]),
        (2048, [pair(1, 4332.0, 1928.5, 0.274, 44.58), pair(2, 16593.7, 6991.6, 0.263, 46.23), pair(4, 83840.8, 25808.9, 0.257, 46.58)]),
    ]),
    ("Ben", 78_039, [
        (512, [pair(1, 345.2, 191.7, 0.288, 44.25), pair(2, 1314.3, 619.3, 0.270, 47.81), pair(4, 4802.3, 2086.2, 0.260, 50.92)]),
        (1024, [pair(1, 1275.8, 575.2, 0.270, 45.46), pair(2, 4586.9, 1946.6, 0.260, 49.55), pair(4, 18007.2, 7230.0, 0.255, 51.66)]),
        (2048, [pair(1, 4654.1, 1927.7, 0.260, 47.23), pair(2, 17789.7, 6868.0, 0.255, 51.00), pair(4, 78791.9, 26620.5, 0.253, 52.14)]),
    ]),
    ("Kitchen", 101_015, [
        (512, [pair(1, 356.0, 278.8, 0.394, 37.89), pair(2, 1319.8, 834.0, 0.345, 43.99), pair(4, 4870.8, 2866.7, 0.312, 48.40)]),
        (1024, [pair(1, 1296.9, 828.0, 0.345, 39.14), pair(2, 4796.9, 2656.5, 0.312, 45.22), pair(4, 18244.1, 8978.5, 0.291, 48.83)]),
        (2048, [pair(1, 4777.8, 2634.1, 0.312, 39.79), pair(2, 17738.9, 8620.8, 0.291, 46.04), pair(4, 68734.2, 29885.4, 0.276, 49.14)]),
    ]),
    ("Conference", 190_947, [
        (512, [pair(1, 230.6, 173.1, 0.336, 47.44), pair(2, 842.5, 549.0, 0.300, 50.56), pair(4, 3414.4, 1958.2, 0.277, 51.11)]),
        (1024, [pair(1, 841.6, 508.1, 0.300, 48.92), pair(2, 3284.0, 1803.9, 0.277, 50.35), pair(4, 12700.4, 6729.4, 0.265, 51.58)]),
        (2048, [pair(1, 3216.5, 1666.2, 0.277, 50.89), pair(2, 12640.0, 6157.8, 0.265, 51.41), pair(4, 49223.0, 23200.3, 0.258, 51.61)]),
    ]),
    ("Bathroom", 268_725, [
        (512, [pair(1, 319.4, 240.6, 0.355, 36.63), pair(2, 1223.8, 857.0, 0.318, 44.31), pair(4, 4384.2, 2805.8, 0.294, 48.60)]),
        (1024, [pair(1, 1169.5, 733.6, 0.318, 40.54), pair(2, 4331.8, 2561.0, 0.294, 46.41), pair(4, 16759.8, 8480.6, 0.280, 49.12)]),
        (2048, [pair(1, 4293.7, 2456.2, 0.294, 41.85), pair(2, 16555.3, 8183.9, 0.280, 47.25), pair(4, 64030.8, 28831.4, 0.270, 49.85)]),
    ]),
    ("San Miguel", 588_402, [
        (512, [pair(1, 382.5, 324.2, 0.395, 36.87), pair(2, 1357.0, 978.4, 0.340, 43.10), pair(4, 4910.6, 3375.9, 0.300, 46.47)]),
        (1024, [pair(1, 1344.3, 905.4, 0.340, 39.16), pair(2, 4833.8, 2923.6, 0.300, 43.18), pair(4, 17917.2, 9987.0, 0.278, 48.08)]),
        (2048, [pair(1, 4814.2, 2838.4, 0.300, 38.06), pair(2, 17845.4, 8774.0, 0.278, 45.89), pair(4, 67949.8, 31442.0, 0.265, 49.51)]),
    ]),
];

/// Table 4: the hairball, 3840x2160.
pub const TABLE_4: [Pair; 5] = [
    pair(1, 5200.0, 2600.0, 0.390, 31.72),
    pair(2, 18900.0, 9400.0, 0.378, 37.73),
    pair(4, 66600.0, 32600.0, 0.360, 42.21),
    pair(8, 232_100.0, 110_300.0, 0.343, 45.62),
    pair(16, 803_800.0, 369_600.0, 0.329, 48.16),
];

/// The steps of [`TABLE_3A`], and the passes that do them.
pub const STEPS: [(&str, &str); 8] = [
    ("I", "base"),
    ("II-a", "similarity_a1"),
    ("II-b", "compact_a1"),
    ("II-c", "trace_a1"),
    ("III-a", "similarity_a2"),
    ("III-b", "compact_a2"),
    ("III-c", "trace_a2"),
    ("IV", "postcorrect"),
];

/// Table 3(a): milliseconds by step, and all else, 1024x1024.
pub const TABLE_3A: [(&str, [f64; 9]); 6] = [
    ("Café", [284.3, 25.9, 10.4, 53.7, 38.5, 11.1, 94.6, 60.8, 11.8]),
    ("Ben", [329.8, 25.4, 11.5, 40.2, 36.8, 10.7, 66.7, 44.3, 9.8]),
    ("Kitchen", [341.7, 26.3, 10.2, 99.4, 37.5, 10.7, 207.1, 81.9, 13.2]),
    ("Conference", [206.4, 23.8, 10.0, 38.7, 37.3, 11.6, 81.8, 86.7, 11.6]),
    ("Bathroom", [300.7, 27.0, 10.0, 84.9, 37.1, 11.1, 185.2, 66.5, 11.0]),
    ("San Miguel", [362.7, 24.0, 10.7, 126.0, 34.3, 11.0, 198.1, 130.0, 8.7]),
];

/// Table 3(b), Bathroom: share of reflective pixels, full and their milliseconds.
pub const TABLE_3B: [(f64, f64, f64); 5] = [
    (0.199, 813.3, 454.0),
    (0.411, 870.2, 451.8),
    (0.609, 992.8, 495.1),
    (0.820, 1054.4, 493.5),
    (0.999, 1077.3, 437.0),
];

/// Table 3(c), Conference: RT ratio, full and their milliseconds.
pub const TABLE_3C: [(f64, f64, f64); 5] = [
    (0.259, 944.6, 362.1),
    (0.266, 884.7, 414.4),
    (0.280, 866.4, 460.4),
    (0.291, 859.8, 521.7),
    (0.321, 904.7, 606.1),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's own columns check the copy: table 3(a) sums to table 5's time.
    #[test]
    fn the_steps_sum_to_the_frame() {
        for ((name, steps), (same, _, sizes)) in TABLE_3A.iter().zip(&TABLE_5) {
            assert_eq!(name, same);
            let frame = sizes[1].1[0].ours_ms;
            assert!((steps.iter().sum::<f64>() - frame).abs() < 0.5, "{name}");
        }
    }

    /// A stage of another name would count among all else.
    #[test]
    fn every_step_is_a_stage() {
        assert!(STEPS.iter().all(|(_, pass)| glimpse::Tracing::of_pass(pass).is_some()));
    }

    /// A grid of twice the side has the samples of a frame of twice the side.
    #[test]
    fn ratios_of_equal_grids_agree() {
        for (name, _, [(_, small), (_, middle), (_, large)]) in &TABLE_5 {
            assert_eq!(
                (small[1].rt_ratio, small[2].rt_ratio),
                (middle[0].rt_ratio, middle[1].rt_ratio),
                "{name}"
            );
            assert_eq!(
                (middle[1].rt_ratio, middle[2].rt_ratio),
                (large[0].rt_ratio, large[1].rt_ratio),
                "{name}"
            );
        }
    }
}

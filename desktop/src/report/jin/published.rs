//! Table 2 and the captions of Figure 7, as printed.

/// A row of [`TABLE_2`].
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// What was rendered.
    pub sampling: &'static str,
    /// Decibels against 256 samples a pixel.
    pub psnr_db: f64,
    /// Samples a pixel; those of theirs are printed as a share of 9.
    pub samples: f64,
    /// Frames a second.
    pub fps: f64,
    /// Frame time over that of one sample a pixel.
    pub overhead: f64,
}

const fn fixed(sampling: &'static str, samples: f64, psnr_db: f64, fps: f64, overhead: f64) -> Line {
    Line { sampling, psnr_db, samples, fps, overhead }
}

const fn ours(sampling: &'static str, percent_of_9: f64, psnr_db: f64, fps: f64, overhead: f64) -> Line {
    Line { sampling, psnr_db, samples: 9.0 * percent_of_9 / 100.0, fps, overhead }
}

/// Scene, thousands of triangles, and its rows, 1024x1024.
#[rustfmt::skip]
pub const TABLE_2: [(&str, u32, &[Line]); 5] = [
    ("Bathroom", 268, &[
        fixed("fixed 16", 16.0, 46.35, 0.79, 8.68),
        ours("theirs, tau_alpha 0.6", 24.6, 44.03, 2.14, 3.22),
        fixed("fixed 9", 9.0, 43.47, 1.23, 5.62),
        fixed("fixed 4", 4.0, 39.36, 2.36, 2.92),
        fixed("fixed 1", 1.0, 35.06, 6.89, 1.00),
    ]),
    ("Conference", 190, &[
        fixed("fixed 16", 16.0, 47.43, 1.39, 9.54),
        ours("theirs, tau_alpha 0.6", 19.8, 46.67, 4.58, 2.88),
        fixed("fixed 9", 9.0, 44.48, 2.28, 5.81),
        fixed("fixed 4", 4.0, 40.54, 4.52, 2.92),
        fixed("fixed 1", 1.0, 36.43, 13.23, 1.00),
    ]),
    ("Room", 117, &[
        fixed("fixed 16", 16.0, 47.61, 1.19, 9.96),
        ours("theirs, tau_alpha 0.6", 17.4, 44.56, 5.72, 2.07),
        fixed("fixed 9", 9.0, 44.31, 1.92, 6.15),
        fixed("fixed 4", 4.0, 39.76, 3.92, 3.02),
        fixed("fixed 1", 1.0, 35.98, 11.83, 1.00),
    ]),
    ("Kitchen", 101, &[
        fixed("fixed 16", 16.0, 46.78, 1.24, 10.12),
        ours("theirs, tau_alpha 0.6", 22.4, 44.16, 4.46, 2.81),
        fixed("fixed 9", 9.0, 43.85, 2.01, 6.22),
        fixed("fixed 4", 4.0, 39.72, 4.09, 3.07),
        fixed("fixed 1", 1.0, 35.58, 12.53, 1.00),
    ]),
    ("Fairy Forest", 174, &[
        fixed("fixed 16", 16.0, 47.22, 1.16, 9.20),
        ours("theirs, tau_alpha 0.1", 106.5, 44.11, 1.28, 8.34),
        fixed("fixed 9", 9.0, 43.88, 1.86, 5.74),
        ours("theirs, tau_alpha 0.3", 28.6, 39.92, 2.82, 3.78),
        fixed("fixed 4", 4.0, 39.19, 3.68, 2.90),
        ours("theirs, tau_alpha 0.6", 19.5, 38.61, 3.75, 2.84),
        ours("theirs, tau_alpha 1, tau_psc = tau_ssc = 1", 16.5, 37.80, 4.51, 2.36),
        ours("theirs, the same, fairy focused", 13.5, 36.05, 5.02, 2.12),
        fixed("fixed 1", 1.0, 35.00, 10.68, 1.00),
    ]),
];

/// Figure 7: thresholds, samples over those of 16 a pixel, PSNR in decibels.
pub const FIGURE_7: [(&str, f64, f64); 8] = [
    ("single 0.1", 0.2262, 46.20),
    ("single 0.2", 0.1609, 44.17),
    ("single 0.3", 0.1376, 42.96),
    ("single 0.4", 0.1186, 41.21),
    ("multiple 0.1", 0.1575, 46.17),
    ("multiple 0.2", 0.1306, 45.75),
    ("multiple 0.3", 0.1220, 45.46),
    ("multiple 0.4", 0.1183, 45.20),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's own columns check the copy: its overheads are ratios of its frame rates, both rounded.
    #[test]
    fn overheads_are_ratios_of_frame_rates() {
        for (scene, _, lines) in &TABLE_2 {
            let single = lines.last().unwrap();
            assert_eq!((single.sampling, single.overhead), ("fixed 1", 1.0), "{scene}");
            for line in *lines {
                let rounding = 0.005 + line.overhead * (0.005 / line.fps + 0.005 / single.fps);
                let off = (single.fps / line.fps - line.overhead).abs();
                assert!(off <= rounding, "{scene}, {}: off by {off}", line.sampling);
            }
        }
    }

    #[test]
    fn more_samples_give_more_and_cost_more() {
        for (scene, _, lines) in &TABLE_2 {
            for pair in lines.windows(2) {
                assert!(pair[0].psnr_db > pair[1].psnr_db, "{scene}, {}", pair[0].sampling);
            }
        }
        for half in FIGURE_7.chunks(4) {
            assert!(half.windows(2).all(|pair| pair[0].1 > pair[1].1 && pair[0].2 > pair[1].2), "{half:?}");
        }
    }
}

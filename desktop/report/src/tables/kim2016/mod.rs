//! Tables of Kim, Seo, Kim, Lim, Nah, Ihm, "Adaptive Undersampling for Efficient Mobile Ray Tracing", The
//! Visual Computer 32, 2016 (Adreno 420; table 4: AMD Radeon R9 Fury X), beside the figures as printed.

pub mod missing;
pub mod table3a;
pub mod table3b;
pub mod table3c;
pub mod table4;
pub mod table5;

use glimpse::{Method, Settings};

use crate::bench::Measured;
use crate::job::Job;
use crate::rung::{Family, Rung};

/// Citation of the paper.
pub const CITATION: &str = "Kim, Seo, Kim, Lim, Nah, Ihm, \"Adaptive Undersampling for Efficient Mobile Ray Tracing\", \
                            The Visual Computer 32, 2016";

/// Sampling rates of tables 4 and 5: samples along the side of a pixel.
const SAMPLINGS: [u32; 3] = [1, 2, 4];

/// A job of full ray tracing and the adaptive method at the same sampling rate.
fn pair_job(table: &'static str, base: &Settings, size: [u32; 2], sampling: u32) -> Job {
    let rung =
        |name, family, method| Rung::beside_full(name, family, Settings { method, sampling, ..*base }, size);
    let full = rung("full", Family::FIXED, Method::Full);
    Job::new(table, size, vec![full, rung("adaptive", Family::TOLERANCES, Method::Adaptive)])
}

/// Full ray tracing and the adaptive method, measured or as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Samples along the side of a pixel.
    pub sampling: u32,
    /// Frame time of full ray tracing in milliseconds.
    pub full_ms: f64,
    /// Frame time of the adaptive method in milliseconds.
    pub adaptive_ms: f64,
    /// RT ratio: traced samples over all samples.
    pub rt_ratio: f64,
    /// PSNR in decibels against full ray tracing at the same sampling rate.
    pub psnr_db: f64,
}

/// Makes a pair from the printed figures.
const fn pair(sampling: u32, full_ms: f64, adaptive_ms: f64, rt_ratio: f64, psnr_db: f64) -> Pair {
    Pair { sampling, full_ms, adaptive_ms, rt_ratio, psnr_db }
}

impl Pair {
    /// Headings of the cells that [`Pair::row`] appends.
    const HEAD: [&str; 7] =
        ["sampling", "full ms", "adaptive ms", "speedup", "RT ratio", "efficiency", "PSNR dB"];

    /// Reads the pair from the measurements of a [`pair_job`].
    fn of(measured: &Measured) -> Self {
        let [full, adaptive] = [0, 1].map(|i| &measured.records[i]);
        Self {
            sampling: measured.job.rungs[0].settings.sampling,
            full_ms: full.time().median,
            adaptive_ms: adaptive.time().median,
            rt_ratio: adaptive.rt_ratio,
            psnr_db: adaptive.psnr_db().unwrap_or(f64::NAN),
        }
    }

    fn speedup(&self) -> f64 {
        self.full_ms / self.adaptive_ms
    }

    /// Makes a row of the given first cells and those of the pair.
    fn row(&self, first: impl IntoIterator<Item = String>) -> Vec<String> {
        let cells = [
            format!("{0}x{0}", self.sampling),
            format!("{:.1}", self.full_ms),
            format!("{:.1}", self.adaptive_ms),
            format!("{:.2}", self.speedup()),
            format!("{:.3}", self.rt_ratio),
            format!("{:.2}", self.speedup() * self.rt_ratio),
            format!("{:.2}", self.psnr_db),
        ];
        first.into_iter().chain(cells).collect()
    }
}

/// A row of tables 3(b) and 3(c): the varied share and the times.
fn varied(scene: &str, share: f64, full_ms: f64, adaptive_ms: f64) -> Vec<String> {
    vec![
        scene.to_owned(),
        format!("{:.1} %", 100.0 * share),
        format!("{full_ms:.1}"),
        format!("{adaptive_ms:.1}"),
        format!("{:.2}", full_ms / adaptive_ms),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pair_says_what_the_paper_says() {
        let row = table5::PUBLISHED[0].2[1].1[0].row([]);
        assert_eq!(row, ["1x1", "1211.7", "591.2", "2.05", "0.294", "0.60", "43.99"]);
        assert_eq!(varied("s", 0.199, 813.3, 454.0)[1..], ["19.9 %", "813.3", "454.0", "1.79"]);
    }

    /// Checks the transcription: the steps of table 3(a) sum to the time in table 5.
    #[test]
    fn the_steps_sum_to_the_frame() {
        for ((name, steps), (same, _, sizes)) in table3a::PUBLISHED.iter().zip(&table5::PUBLISHED) {
            assert_eq!(name, same);
            let frame = sizes[1].1[0].adaptive_ms;
            assert!((steps.iter().sum::<f64>() - frame).abs() < 0.5, "{name}");
        }
    }
}

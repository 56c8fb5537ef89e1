//! Jin 2009, Table 2: fixed sampling densities against supersampling where neighbours differ.

use glimpse::{Method, Settings};

use super::{CITATION, samples_a_pixel};
use crate::bench::Measured;
use crate::job::{Job, Reference};
use crate::ladder;
use crate::record::Record;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured, settings};

/// Fixed densities against supersampling, alone and after the adaptive method.
pub struct Supersampling;

impl Table for Supersampling {
    fn name(&self) -> &'static str {
        "jin2"
    }

    fn summary(&self) -> &'static str {
        "Fixed samples against extra samples where neighbours differ (Jin 2009, Table 2)"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let (base, size) = (request.base, request.size);
        vec![Job {
            reference: Reference::Converged { settings: ladder::converged(base), beside_first: false },
            against: "converged, of table 2",
            ..Job::new(self.name(), size, rungs(base, size))
        }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let ours = measured(scenes, self.name())
            .flat_map(|(scene, measured)| rows(&scene.sized(measured.job.shown), &lines(measured)));
        let published = PUBLISHED.iter().flat_map(|(scene, thousands, lines)| {
            let lines: Vec<_> = lines.iter().map(Line::from).collect();
            rows(&format!("{scene} ({thousands}K), 1024x1024"), &lines)
        });
        Content::Rows(Rows {
            title: "Jin 2009, Table 2: fixed and adaptive supersampling",
            note: "PSNR against 256 samples a pixel. Supersample is the paper's method; combined adds the same extra samples \
                   to the adaptive method (2x2 blocks, default tolerances, postcorrection by what the scene holds). Balanced: \
                   tau_alpha = tau_col = tau_pte = tau_ste = 0.6, tau_psc = tau_ssc = 0.06; textures: tau_alpha = 0.1; edges: \
                   tau_alpha = tau_psc = tau_ssc = 1; all with tau_poid = tau_soid = 0.05 and tau_psn = tau_ssn = 0.06, as \
                   the paper (its Conference: tau_poid = tau_soid = 0). Of the paper's figures, milliseconds are 1000 over \
                   frames a second, and samples a pixel of its method are 9 times their share of fixed 9."
                .to_owned(),
            head: HEAD.to_vec(),
            measured: ours.collect(),
            published: published.collect(),
            citation: CITATION,
        })
    }
}

/// 1 to 16 fixed samples per pixel, supersampling alone and after the adaptive method, and quincunx sampling.
fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let adaptive = Settings { method: Method::Adaptive, ..*base };
    let quincunx = Settings { method: Method::Quincunx, ..*base };
    let quincunx = ("quincunx".to_owned(), Family::QUINCUNX, quincunx);
    let fixed = ladder::fixed(base).into_iter();
    let all = fixed.chain(ladder::extra_samples(&adaptive)).chain([quincunx]);
    all.map(|(name, family, settings)| Rung::beside_converged(name, family, settings, size)).collect()
}

const HEAD: [&str; 8] = [
    "scene",
    "sampling",
    "PSNR dB",
    "samples a pixel",
    "of fixed 9",
    "ms",
    "overhead over fixed 1",
    "frame rate / fixed 9",
];

/// Cost and quality of one setting.
struct Line<'l> {
    /// Short name of a measured setting; empty for a printed one.
    code: &'l str,
    name: &'l str,
    psnr_db: f64,
    samples: f64,
    ms: f64,
    /// Frame time over that of one sample per pixel.
    overhead: f64,
}

impl<'l> From<&'l PrintedLine> for Line<'l> {
    fn from(line: &'l PrintedLine) -> Self {
        Self {
            code: "",
            name: line.sampling,
            psnr_db: line.psnr_db,
            samples: line.samples,
            ms: 1000.0 / line.fps,
            overhead: line.overhead,
        }
    }
}

fn lines<'m>(measured: &'m Measured) -> Vec<Line<'m>> {
    let single = measured.records.first().map_or(f64::NAN, |record| record.time().median);
    let line = |(rung, record): (&'m Rung, &'m Record)| Line {
        code: &rung.code,
        name: &rung.name,
        psnr_db: record.psnr_db().unwrap_or(f64::NAN),
        samples: samples_a_pixel(rung, record),
        ms: record.time().median,
        overhead: record.time().median / single,
    };
    settings(measured).map(line).collect()
}

fn rows(scene: &str, lines: &[Line<'_>]) -> Vec<Vec<String>> {
    let nine = lines.iter().find(|line| line.name == "fixed 9").map_or(f64::NAN, |line| line.ms);
    let row = |line: &Line<'_>| {
        vec![
            scene.to_owned(),
            format!("{} {}", line.code, line.name).trim_start().to_owned(),
            format!("{:.2}", line.psnr_db),
            format!("{:.2}", line.samples),
            format!("{:.1} %", 100.0 * line.samples / 9.0),
            format!("{:.1}", line.ms),
            format!("{:.2}", line.overhead),
            format!("{:.2}", nine / line.ms),
        ]
    };
    lines.iter().map(row).collect()
}

/// A row of [`PUBLISHED`].
#[derive(Clone, Copy, Debug)]
struct PrintedLine {
    /// Label of the setting.
    sampling: &'static str,
    /// PSNR in decibels against 256 samples per pixel.
    psnr_db: f64,
    /// Samples per pixel; the paper prints those of its method as a share of 9.
    samples: f64,
    /// Frames per second.
    fps: f64,
    /// Frame time over that of one sample per pixel.
    overhead: f64,
}

const fn fixed(sampling: &'static str, samples: f64, psnr_db: f64, fps: f64, overhead: f64) -> PrintedLine {
    PrintedLine { sampling, psnr_db, samples, fps, overhead }
}

const fn ours(
    sampling: &'static str,
    percent_of_9: f64,
    psnr_db: f64,
    fps: f64,
    overhead: f64,
) -> PrintedLine {
    PrintedLine { sampling, psnr_db, samples: 9.0 * percent_of_9 / 100.0, fps, overhead }
}

/// As printed for 1024x1024: scene, thousands of triangles, and the rows.
#[rustfmt::skip]
const PUBLISHED: [(&str, u32, &[PrintedLine]); 5] = [
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::example;

    #[test]
    fn fixed_densities_stand_beside_every_preset_alone_and_combined() {
        let base = Settings { depth: 7, ..Settings::default() };
        let rungs = rungs(&base, [32, 24]);
        for rung in &rungs {
            rung.settings.validate().unwrap();
            assert_eq!((rung.settings.depth, rung.rendered, rung.keeps_picture), (7, [32, 24], false));
        }
        let names: Vec<_> = rungs.iter().map(|rung| rung.name.as_str()).collect();
        assert_eq!(names[..4], ["fixed 1", "fixed 4", "fixed 9", "fixed 16"]);
        let extra = ["edges", "balanced", "textures"]
            .map(|preset| [format!("supersample {preset}"), format!("combined {preset}")]);
        assert_eq!(names[4..10], extra.concat());
        assert_eq!(names[10..], ["quincunx"]);
        for pair in rungs[4..10].chunks(2) {
            assert_eq!(pair[0].settings.thresholds, pair[1].settings.thresholds);
        }
    }

    #[test]
    fn shares_and_rates_are_against_fixed_densities() {
        let line =
            |name, samples, ms| Line { code: "", name, psnr_db: 40.0, samples, ms, overhead: ms / 10.0 };
        let rows = rows("s", &[line("fixed 1", 1.0, 10.0), line("fixed 9", 9.0, 80.0), line("a", 1.8, 20.0)]);
        assert_eq!(rows[2], ["s", "a", "40.00", "1.80", "20.0 %", "20.0", "2.00", "4.00"]);
        assert_eq!(rows[1][3..], ["9.00", "100.0 %", "80.0", "8.00", "1.00"]);
    }

    /// Printed for the Bathroom: "44.03 (24.6%) 2.14 (3.22)".
    #[test]
    fn the_papers_rows_say_what_it_prints() {
        let (_, _, lines) = PUBLISHED[0];
        let rows = rows("Bathroom", &lines.iter().map(Line::from).collect::<Vec<_>>());
        assert_eq!(rows[1][2..], ["44.03", "2.21", "24.6 %", "467.3", "3.22", "1.74"]);
    }

    #[test]
    fn samples_of_a_grid_are_those_of_its_pixels() {
        let rungs = rungs(&Settings::default(), [4, 4]);
        let samples = |i: usize| samples_a_pixel(&rungs[i], &example("r", 1.0, None));
        assert!((samples(2) - 9.0 * 0.34).abs() < 1e-12 && (samples(4) - 0.34).abs() < 1e-12);
    }

    /// Checks the transcription against the paper itself: its overheads are ratios of its frame rates, both
    /// rounded.
    #[test]
    fn overheads_are_ratios_of_frame_rates() {
        for (scene, _, lines) in &PUBLISHED {
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
    fn more_samples_give_more() {
        for (scene, _, lines) in &PUBLISHED {
            for pair in lines.windows(2) {
                assert!(pair[0].psnr_db > pair[1].psnr_db, "{scene}, {}", pair[0].sampling);
            }
        }
    }
}

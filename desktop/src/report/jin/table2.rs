//! Table 2: fixed densities against extra samples where neighbours differ.

use glimpse::{Method, Settings};

use super::published::{self, TABLE_2};
use super::{CITATION, samples_a_pixel};
use crate::args::TableName;
use crate::report::SceneReport;
use crate::report::bench::Measured;
use crate::report::ladder::{Family, Rung, extra_samples, fixed};
use crate::report::record::Record;
use crate::report::tables::{self, Table};

/// 1 to 16 fixed samples a pixel, extra samples alone and after the adaptive method, and quincunxes.
pub fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let adaptive = Settings { method: Method::Adaptive, ..*base };
    let quincunx = Settings { method: Method::Quincunx, ..*base };
    let quincunx = ("quincunx".to_owned(), Family::Quincunx, quincunx);
    let all = fixed(base).into_iter().chain(extra_samples(&adaptive)).chain([quincunx]);
    all.map(|(name, family, settings)| Rung { name, family, settings, rendered: size, keeps_picture: false })
        .collect()
}

/// A row for every setting.
pub fn table(scenes: &[SceneReport]) -> Table {
    let ours = tables::of(scenes, TableName::Supersampling).flat_map(|(scene, measured)| {
        let [width, height] = measured.job.shown;
        rows(&format!("{}, {width}x{height}", scene.prepared.name), &lines(measured))
    });
    let paper = TABLE_2.iter().flat_map(|(scene, thousands, lines)| {
        rows(&format!("{scene} ({thousands}K), 1024x1024"), &lines.iter().map(Line::from).collect::<Vec<_>>())
    });
    Table {
        title: "Jin 2009, Table 2: fixed and adaptive supersampling".to_owned(),
        note: "PSNR against 256 samples a pixel. Supersample is the paper's method; combined adds the same extra samples to \
               the adaptive method (2x2 blocks, default tolerances, postcorrection by what the scene holds). Balanced: \
               tau_alpha = tau_col = tau_pte = tau_ste = 0.6, tau_psc = tau_ssc = 0.06; textures: tau_alpha = 0.1; edges: \
               tau_alpha = tau_psc = tau_ssc = 1; all with tau_poid = tau_soid = 0.05 and tau_psn = tau_ssn = 0.06, as the \
               paper (its Conference: tau_poid = tau_soid = 0). Of the paper's figures, milliseconds are 1000 over frames a \
               second, and samples a pixel of its method are 9 times their share of fixed 9."
            .to_owned(),
        head: HEAD.to_vec(),
        ours: ours.collect(),
        paper: paper.collect(),
        citation: CITATION,
    }
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

/// What one setting costs and gives.
struct Line<'l> {
    name: &'l str,
    psnr_db: f64,
    samples: f64,
    ms: f64,
    /// Time over that of one sample a pixel.
    overhead: f64,
}

impl<'l> From<&'l published::Line> for Line<'l> {
    fn from(line: &'l published::Line) -> Self {
        Self {
            name: line.sampling,
            psnr_db: line.psnr_db,
            samples: line.samples,
            ms: 1000.0 / line.fps,
            overhead: line.overhead,
        }
    }
}

fn lines<'m>(measured: &'m Measured) -> Vec<Line<'m>> {
    let settings = measured.job.rungs.iter().zip(&measured.records);
    let single = measured.records.first().map_or(f64::NAN, |record| record.time().median);
    let line = |(rung, record): (&'m Rung, &'m Record)| Line {
        name: &rung.name,
        psnr_db: record.psnr_db().unwrap_or(f64::NAN),
        samples: samples_a_pixel(rung, record),
        ms: record.time().median,
        overhead: record.time().median / single,
    };
    settings.map(line).collect()
}

fn rows(scene: &str, lines: &[Line<'_>]) -> Vec<Vec<String>> {
    let nine = lines.iter().find(|line| line.name == "fixed 9").map_or(f64::NAN, |line| line.ms);
    let row = |line: &Line<'_>| {
        vec![
            scene.to_owned(),
            line.name.to_owned(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::record::tests::example;

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
        let line = |name, samples, ms| Line { name, psnr_db: 40.0, samples, ms, overhead: ms / 10.0 };
        let rows = rows("s", &[line("fixed 1", 1.0, 10.0), line("fixed 9", 9.0, 80.0), line("a", 1.8, 20.0)]);
        assert_eq!(rows[2], ["s", "a", "40.00", "1.80", "20.0 %", "20.0", "2.00", "4.00"]);
        assert_eq!(rows[1][3..], ["9.00", "100.0 %", "80.0", "8.00", "1.00"]);
    }

    /// Bathroom: "44.03 (24.6%) 2.14 (3.22)".
    #[test]
    fn the_papers_rows_say_what_it_prints() {
        let (_, _, lines) = TABLE_2[0];
        let rows = rows("Bathroom", &lines.iter().map(Line::from).collect::<Vec<_>>());
        assert_eq!(rows[1][2..], ["44.03", "2.21", "24.6 %", "467.3", "3.22", "1.74"]);
    }

    #[test]
    fn samples_of_a_grid_are_those_of_its_pixels() {
        let rungs = rungs(&Settings::default(), [4, 4]);
        let samples = |i: usize| samples_a_pixel(&rungs[i], &example("r", 1.0, None));
        assert!((samples(2) - 9.0 * 0.34).abs() < 1e-12 && (samples(4) - 0.34).abs() < 1e-12);
    }
}

//! Jin 2009, Figure 7: one threshold for all attributes against thresholds by attribute.

use glimpse::{Method, Preset, Settings, Thresholds};

use super::{CITATION, samples_a_pixel};
use crate::job::{Job, Reference};
use crate::ladder;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured, settings};

/// Supersampling by colour alone, and by colour with separate thresholds for geometry and shadows.
pub struct SingleAndMultiple;

impl Table for SingleAndMultiple {
    fn name(&self) -> &'static str {
        "jin7"
    }

    fn summary(&self) -> &'static str {
        "One threshold for extra samples against several (Jin 2009, Figure 7)"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let (base, size) = (request.base, request.size);
        vec![Job {
            reference: Reference::Converged { settings: ladder::converged(base), beside_first: false },
            against: "converged, of figure 7",
            ..Job::new(self.name(), size, rungs(base, size))
        }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name()).flat_map(|(scene, measured)| {
            let name = scene.sized(measured.job.shown);
            settings(measured).map(move |(rung, record)| {
                let share = samples_a_pixel(rung, record) / 16.0;
                row(&name, &rung.label(), share, record.psnr_db().unwrap_or(f64::NAN))
            })
        });
        Content::Rows(Rows {
            title: "Jin 2009, Figure 7: single against multiple thresholds",
            note: "Single: all thresholds are tau_col, so that the colour decides alone. Multiple: tau_pte = tau_ste = \
                   tau_col, tau_poid = tau_soid = 0.05, tau_psn = tau_ssn = tau_psc = tau_ssc = 0.06, the paper's defaults. \
                   PSNR against 256 samples a pixel."
                .to_owned(),
            head: vec!["scene", "thresholds, tau_col", "samples / fixed 16", "PSNR dB"],
            measured: rows.collect(),
            published: published(),
            citation: CITATION,
        })
    }
}

fn published() -> Vec<Vec<String>> {
    PUBLISHED.iter().map(|&(name, share, psnr_db)| row("Figure 7", name, share, psnr_db)).collect()
}

/// Colour thresholds tau_col.
const COLORS: [f32; 4] = [0.1, 0.2, 0.3, 0.4];

/// Each tau_col as the only threshold, then with the default thresholds of geometry and shadows.
fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name, thresholds| {
        let settings = Settings { method: Method::Supersample, thresholds, ..*base };
        Rung::beside_converged(name, Family::SUPERSAMPLE, settings, size)
    };
    let single = COLORS.map(|tau| rung(format!("single {tau}"), Thresholds::uniform(tau)));
    let geometry = Preset::Balanced.thresholds();
    let multiple = COLORS
        .map(|tau| rung(format!("multiple {tau}"), Thresholds { col: tau, pte: tau, ste: tau, ..geometry }));
    single.into_iter().chain(multiple).collect()
}

fn row(scene: &str, thresholds: &str, share: f64, psnr_db: f64) -> Vec<String> {
    let [scene, thresholds] = [scene, thresholds].map(str::to_owned);
    vec![scene, thresholds, format!("{:.2} %", 100.0 * share), format!("{psnr_db:.2}")]
}

/// Captions as printed: thresholds, samples as a share of 16 per pixel, PSNR in decibels.
const PUBLISHED: [(&str, f64, f64); 8] = [
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

    #[test]
    fn settings_are_the_papers_rows() {
        let rungs = rungs(&Settings { depth: 7, ..Settings::default() }, [32, 24]);
        assert!(rungs.iter().map(|rung| rung.name.as_str()).eq(PUBLISHED.iter().map(|(name, ..)| *name)));
        for (index, rung) in rungs.iter().enumerate() {
            rung.settings.validate().unwrap();
            assert_eq!((rung.settings.depth, rung.rendered), (7, [32, 24]));
            let t = rung.settings.thresholds;
            let tau = COLORS[index % 4];
            assert_eq!([t.col, t.pte, t.ste], [tau; 3], "{}", rung.name);
            let geometry = if index < 4 { [tau; 3] } else { [0.05, 0.06, 0.06] };
            assert_eq!([t.poid, t.psn, t.psc], geometry, "{}", rung.name);
            assert_eq!([t.soid, t.ssn, t.ssc], geometry, "{}", rung.name);
        }
    }

    /// The caption is "(g) tau_col = 0.1: Sample Ratio = 15.75%, PSNR = 46.17".
    #[test]
    fn the_papers_rows_say_what_it_prints() {
        assert_eq!(published()[4], ["Figure 7", "multiple 0.1", "15.75 %", "46.17"]);
    }

    #[test]
    fn more_samples_give_more_and_cost_more() {
        for half in PUBLISHED.chunks(4) {
            assert!(half.windows(2).all(|pair| pair[0].1 > pair[1].1 && pair[0].2 > pair[1].2), "{half:?}");
        }
    }
}

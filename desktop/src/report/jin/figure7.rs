//! Figure 7: one threshold for everything against thresholds by attribute.

use glimpse::{Method, Preset, Settings, Thresholds};

use super::published::FIGURE_7;
use super::{CITATION, samples_a_pixel};
use crate::args::TableName;
use crate::report::SceneReport;
use crate::report::ladder::{Family, Rung};
use crate::report::tables::{self, Table};

/// The values of tau_col.
const COLORS: [f32; 4] = [0.1, 0.2, 0.3, 0.4];

/// Every tau_col, alone and beside the thresholds of geometry and shadows.
pub fn rungs(base: &Settings, size: [u32; 2]) -> Vec<Rung> {
    let rung = |name, thresholds| Rung {
        name,
        family: Family::Supersample,
        settings: Settings { method: Method::Supersample, thresholds, ..*base },
        rendered: size,
        keeps_picture: false,
    };
    let single = COLORS.map(|tau| rung(format!("single {tau}"), Thresholds::uniform(tau)));
    let geometry = Preset::Balanced.thresholds();
    let multiple = COLORS
        .map(|tau| rung(format!("multiple {tau}"), Thresholds { col: tau, pte: tau, ste: tau, ..geometry }));
    single.into_iter().chain(multiple).collect()
}

/// A row for every setting.
pub fn table(scenes: &[SceneReport]) -> Table {
    let ours = tables::of(scenes, TableName::Thresholds).flat_map(|(scene, measured)| {
        let [width, height] = measured.job.shown;
        let settings = measured.job.rungs.iter().zip(&measured.records);
        settings.map(move |(rung, record)| {
            let share = samples_a_pixel(rung, record) / 16.0;
            let name = format!("{}, {width}x{height}", scene.prepared.name);
            row(&name, &rung.name, share, record.psnr_db().unwrap_or(f64::NAN))
        })
    });
    Table {
        title: "Jin 2009, Figure 7: single against multiple thresholds".to_owned(),
        note: "Single: all thresholds are tau_col, so that the colour decides alone. Multiple: tau_pte = tau_ste = tau_col, \
               tau_poid = tau_soid = 0.05, tau_psn = tau_ssn = tau_psc = tau_ssc = 0.06, the paper's defaults. PSNR against \
               256 samples a pixel."
            .to_owned(),
        head: vec!["scene", "thresholds, tau_col", "samples / fixed 16", "PSNR dB"],
        ours: ours.collect(),
        paper: FIGURE_7.iter().map(|&(name, share, psnr_db)| row("Figure 7", name, share, psnr_db)).collect(),
        citation: CITATION,
    }
}

fn row(scene: &str, thresholds: &str, share: f64, psnr_db: f64) -> Vec<String> {
    let [scene, thresholds] = [scene, thresholds].map(str::to_owned);
    vec![scene, thresholds, format!("{:.2} %", 100.0 * share), format!("{psnr_db:.2}")]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_the_papers_rows() {
        let rungs = rungs(&Settings { depth: 7, ..Settings::default() }, [32, 24]);
        assert!(rungs.iter().map(|rung| rung.name.as_str()).eq(FIGURE_7.iter().map(|(name, ..)| *name)));
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

    /// "(g) tau_col = 0.1: Sample Ratio = 15.75%, PSNR = 46.17".
    #[test]
    fn the_papers_rows_say_what_it_prints() {
        let table = table(&[]);
        assert_eq!(table.paper[4], ["Figure 7", "multiple 0.1", "15.75 %", "46.17"]);
        assert!(table.paper.iter().all(|row| row.len() == table.head.len()));
    }
}

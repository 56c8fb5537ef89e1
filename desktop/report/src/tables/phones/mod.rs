//! "Will it be real time?": predicted frame times of phones, from counted work and published peak rates.

mod calibration;
mod model;
mod rates;
mod section;

use anyhow::Context;
use glimpse::{Method, Settings};
use glimpse_app::Phone;
use serde::{Deserialize, Serialize};

use crate::job::Job;
use crate::rung::{Family, Rung};
use crate::scene::SceneReport;
use crate::table::{Content, Csv, Request, Table, measured};
use calibration::{Calibration, Cell, Check, leave_one_out};
use model::{Bound, Device, Reach, milliseconds};
use rates::PUBLISHED;

/// Predicted frame times of phones.
pub struct Phones;

impl Table for Phones {
    fn name(&self) -> &'static str {
        "phones"
    }

    fn summary(&self) -> &'static str {
        "Predicted times of phones, 2560x1440"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        vec![Job { counts_work: true, ..Job::new(self.name(), SIZE, rungs(request.base)) }]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        match of(scenes) {
            None => Content::Nothing,
            Some(predictions) => Content::Section(section::section(&predictions)),
        }
    }

    fn csv(&self) -> Option<Csv> {
        let bytes = |scenes: &[SceneReport]| match of(scenes) {
            Some(Ok(predictions)) => csv(&predictions.rows),
            _ => csv(&[]),
        };
        Some(Csv { file: "predictions.csv", bytes })
    }
}

/// Size of the predicted frame in pixels.
const SIZE: [u32; 2] = [2560, 1440];

/// Assumed shares of a phone's peak bandwidth that are reached, from the fast case to the slow; [`MISSED`]
/// has the shares of the scene's bytes that miss its caches.
const BANDWIDTH: [f64; 3] = [0.8, 0.7, 0.5];
const MISSED: [f64; 3] = [0.05, 0.15, 0.4];

/// Label of full ray tracing.
const FULL: &str = "full";

/// Predicted methods, full ray tracing first.
fn rungs(base: &Settings) -> Vec<Rung> {
    let rung = |name: &str, family, method, block| {
        Rung::beside_full(name, family, Settings { method, block, ..*base }, SIZE)
    };
    vec![
        rung(FULL, Family::FIXED, Method::Full, base.block),
        rung("checkerboard", Family::CHECKERBOARD, Method::Checkerboard, base.block),
        rung("adaptive", Family::TOLERANCES, Method::Adaptive, base.block),
        rung("block 4", Family::BLOCKS, Method::Adaptive, 4),
    ]
}

/// Predicted time of a scene's frame on a phone, not a measurement.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
struct Prediction {
    /// Name of the scene on the command line.
    pub scene: String,
    /// Label of the setting.
    pub method: String,
    /// Name of the phone, as the emulator takes it.
    pub phone: String,
    /// Name of the graphics device.
    pub gpu: String,
    /// Width of the frame in pixels.
    pub width: u32,
    /// Height of the frame in pixels.
    pub height: u32,
    /// Milliseconds in the fast case.
    pub predicted_low_ms: f64,
    /// Milliseconds in the middle case.
    pub predicted_mid_ms: f64,
    /// Milliseconds in the slow case.
    pub predicted_high_ms: f64,
    /// Frames per second in the middle case.
    pub predicted_mid_fps: f64,
    /// What limits the middle case: `arithmetic` or `memory`.
    pub waits_for: String,
}

/// Everything that the section of the page shows.
struct Predictions {
    /// Calibration of this device.
    pub calibration: Calibration,
    /// Each frame predicted from the other scenes.
    pub checks: Vec<Check>,
    /// The largest ratio between prediction and measurement among the checks, at least 1; 1 with one scene.
    pub factor: f64,
    /// Known shares of peak operations of traced neighbours: of this device, then the published ones.
    pub known: Vec<f64>,
    /// Largest, median and smallest of the known shares.
    pub arithmetic: [f64; 3],
    /// Frames whose work was counted.
    pub cells: Vec<Cell>,
    /// Phones with the sources of their peak rates.
    pub phones: Vec<Phone>,
    /// Predictions by scene, method and phone.
    pub rows: Vec<Prediction>,
}

/// Predictions for the scenes; `None` if the table was not measured.
///
/// # Errors
/// Fails if the file of phones is damaged or the calibration lacks measurements.
fn of(scenes: &[SceneReport]) -> Option<Result<Predictions, String>> {
    let cells: Vec<_> = measured(scenes, Phones.name())
        .flat_map(|(scene, measured)| Cell::all(&scene.prepared.name, measured))
        .collect();
    (!cells.is_empty()).then(|| Predictions::new(cells, Phone::all()?))
}

impl Predictions {
    fn new(cells: Vec<Cell>, phones: Vec<Phone>) -> Result<Self, String> {
        let calibration = Calibration::of(cells.iter())?;
        let checks = leave_one_out(&cells);
        let factor = checks.iter().map(Check::factor).fold(1.0, f64::max);
        let full: Vec<_> = cells.iter().filter(|cell| cell.method == FULL).collect();
        if full.is_empty() {
            return Err("full ray tracing was not measured".to_owned());
        }
        let published = PUBLISHED.iter().map(|published| published.share(&full));
        let known: Vec<_> = std::iter::once(calibration.shares[0]).chain(published).collect();
        let arithmetic = extremes(&known);
        let mut predictions =
            Self { calibration, checks, factor, known, arithmetic, cells, phones, rows: Vec::new() };
        predictions.rows = predictions.predict();
        Ok(predictions)
    }

    fn predict(&self) -> Vec<Prediction> {
        let pairs = self.cells.iter().flat_map(|cell| self.phones.iter().map(move |phone| (cell, phone)));
        let row = |(cell, phone): (&Cell, &Phone)| {
            let [(low, _), (mid, bound), (high, _)] = [0, 1, 2].map(|case| self.frame(cell, phone, case));
            Prediction {
                scene: cell.scene.clone(),
                method: cell.method.clone(),
                phone: phone.name.clone(),
                gpu: phone.gpu.clone(),
                width: SIZE[0],
                height: SIZE[1],
                predicted_low_ms: low / self.factor,
                predicted_mid_ms: mid,
                predicted_high_ms: high * self.factor,
                predicted_mid_fps: 1000.0 / mid,
                waits_for: if bound == Bound::Memory { "memory" } else { "arithmetic" }.to_owned(),
            }
        };
        pairs.map(row).collect()
    }

    /// Milliseconds of a frame on a phone in the fast, middle or slow `case` (0 to 2), and what limits most
    /// of it.
    fn frame(&self, cell: &Cell, phone: &Phone, case: usize) -> (f64, Bound) {
        let device = Device { gflops: phone.gflops.value, gigabytes: phone.gigabytes.value };
        let mut by_bound = [0.0; 2];
        for (load, share) in cell.loads.iter().zip(self.calibration.shares) {
            // Classes of passes keep the ratios that they have on this device.
            let arithmetic = self.arithmetic[case] * share / self.calibration.shares[0];
            let reach = Reach { arithmetic, bandwidth: BANDWIDTH[case], missed: MISSED[case] };
            let (ms, bound) = milliseconds(load, device, reach);
            by_bound[bound as usize] += ms;
        }
        let bound = if by_bound[1] > by_bound[0] { Bound::Memory } else { Bound::Arithmetic };
        (by_bound.iter().sum(), bound)
    }
}

/// Largest, median and smallest value.
fn extremes(values: &[f64]) -> [f64; 3] {
    let mut sorted = values.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    [sorted[0], sorted[sorted.len() / 2], sorted[sorted.len() - 1]]
}

/// Writes the predictions as comma-separated values.
fn csv(rows: &[Prediction]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).context("CSV")?;
    }
    writer.into_inner().context("CSV")
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use calibration::tests::{cell, scenes};

    /// Predictions of two scenes for every phone.
    pub(super) fn predictions() -> Predictions {
        Predictions::new(scenes(), Phone::all().expect("the file")).expect("calibrated")
    }

    #[test]
    fn every_frame_is_predicted_for_every_phone_with_its_range() {
        let found = predictions();
        assert_eq!(found.rows.len(), found.cells.len() * found.phones.len());
        assert!((found.factor - 2.0).abs() < 1e-9);
        for row in &found.rows {
            let range = [row.predicted_low_ms, row.predicted_mid_ms, row.predicted_high_ms];
            assert!(range.iter().all(|ms| ms.is_finite() && *ms > 0.0) && range.is_sorted(), "{row:?}");
            // The check that is off by two widens both ends.
            assert!(range[1] / range[0] >= 2.0 && range[2] / range[1] >= 2.0, "{row:?}");
            assert!((row.predicted_mid_fps * row.predicted_mid_ms - 1000.0).abs() < 1e-6, "{row:?}");
        }
    }

    #[test]
    fn a_prediction_is_the_sum_of_its_passes() {
        let mut found = predictions();
        found.calibration = Calibration { peak_gflops: 100.0, shares: [0.2, 0.1, 0.4] };
        found.arithmetic = [0.4, 0.2, 0.1];
        let mut phone = found.phones[0].clone();
        (phone.gflops.value, phone.gigabytes.value) = (1000.0, 1e9);
        let frame = cell("a", "adaptive", [10e9, 5e9, 4e9], [0.0; 3]);
        // At 200, 100 and 400 billion operations a second: 50 + 50 + 10 ms; twice and half of that.
        let times = [0, 1, 2].map(|case| found.frame(&frame, &phone, case).0);
        assert!(times.iter().zip([55.0, 110.0, 220.0]).all(|(a, b)| (a - b).abs() < 1e-9), "{times:?}");
        // 0.2 + 0.15 x 4 billion bytes less: 0.01 and 0.15 x 0.2 of 19 billion operations at 0.7 of a billion a second.
        phone.gigabytes.value = 1.0;
        let (ms, bound) = found.frame(&frame, &phone, 1);
        assert!((ms - 0.04 * 19e9 / 0.7e9 * 1e3).abs() < 1e-6 && bound == Bound::Memory, "{ms}");
    }

    #[test]
    fn the_range_of_shares_is_what_is_known() {
        let found = predictions();
        assert_eq!(found.known.len(), 1 + PUBLISHED.len());
        assert_eq!(found.known[0], found.calibration.shares[0]);
        assert_eq!(extremes(&[0.1, 0.3, 0.2]), [0.3, 0.2, 0.1]);
        assert!(found.arithmetic.is_sorted_by(|a, b| a >= b));
    }

    #[test]
    fn what_was_not_timed_is_not_predicted() {
        let untimed: Vec<_> = scenes().into_iter().map(|cell| Cell { frames: vec![], ..cell }).collect();
        let lack = Predictions::new(untimed, Phone::all().expect("the file")).err().expect("no times");
        assert!(lack.contains("could not be measured"), "{lack}");
        assert!(of(&[]).is_none(), "nobody asked");
    }

    #[test]
    fn csv_parses_back() {
        let rows = predictions().rows;
        let bytes = csv(&rows).expect("CSV");
        let parsed: Vec<Prediction> =
            csv::Reader::from_reader(bytes.as_slice()).deserialize().map(|row| row.expect("a row")).collect();
        assert_eq!(parsed.len(), rows.len());
        assert_eq!((&parsed[0].phone, &parsed[0].waits_for), (&rows[0].phone, &rows[0].waits_for));
        assert!((parsed[0].predicted_mid_ms - rows[0].predicted_mid_ms).abs() < 1e-9);
        let head = String::from_utf8(bytes).expect("text");
        assert!(head.starts_with("scene,method,phone,gpu,width,height,predicted_low_ms,"), "{head}");
    }
}

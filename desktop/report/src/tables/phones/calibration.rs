//! Calibrates the cost model: the shares of its peak that this device reaches in the timed passes, and how
//! well they predict a scene left out of the calibration.

use glimpse::{Demand, Tracing};
use glimpse_measure::statistics::Spread;

use crate::bench::Measured;
use crate::record::Frame;
use crate::work::class_name;

/// A frame whose work was counted and timed.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Name of the scene.
    pub scene: String,
    /// Label of the setting.
    pub method: String,
    /// Operations and bytes by class of passes ([`Tracing`]).
    pub loads: [Demand; 3],
    /// Timed frames.
    pub frames: Vec<Timed>,
    /// Number of rays of all kinds.
    pub rays: u64,
    /// Number of visited nodes of the acceleration structure.
    pub node_visits: u64,
    /// Number of intersection tests with triangles and spheres.
    pub primitive_tests: u64,
    /// Number of pixels of the frame.
    pub pixels: u64,
}

impl Cell {
    /// Cells of all settings of a measurement whose work was counted.
    pub fn all(scene: &str, measured: &Measured) -> Vec<Self> {
        let counted = measured.job.rungs.iter().zip(&measured.records);
        let counted = counted.filter_map(|(rung, record)| {
            let work = record.work.as_ref()?;
            Some(Self {
                scene: scene.to_owned(),
                method: rung.name.clone(),
                loads: work.loads,
                frames: record.frames.iter().map(Timed::of).collect(),
                rays: record.rays,
                node_visits: work.node_visits,
                primitive_tests: work.primitive_tests,
                pixels: record.pixels,
            })
        });
        counted.collect()
    }

    /// Operations of the whole frame.
    pub fn operations(&self) -> f64 {
        self.loads.iter().map(|load| load.operations).sum()
    }

    /// Share of the peak that a class of passes reaches: the median over frames, each against the peak
    /// measured right after it, so that other load of the device affects both alike. `None` if nothing was
    /// timed.
    fn share(&self, class: Tracing) -> Option<f64> {
        let operations = self.loads[class as usize].operations;
        let shares = self.frames.iter().filter_map(|frame| {
            let share = operations / frame.ms[class as usize] * 1e-6 / frame.peak_gflops?;
            positive(&share).then_some(share)
        });
        median(shares)
    }

    /// Median milliseconds of all passes, and the median peak of the device in billions of operations per
    /// second.
    fn measured(&self) -> Option<(f64, f64)> {
        let ms = self.frames.iter().map(|frame| frame.ms.iter().sum()).filter(positive);
        median(ms).zip(median(self.peaks()))
    }

    fn peaks(&self) -> impl Iterator<Item = f64> {
        self.frames.iter().filter_map(|frame| frame.peak_gflops).filter(positive)
    }
}

/// Pass times of one frame.
#[derive(Clone, Debug)]
pub struct Timed {
    /// Milliseconds by class of passes ([`Tracing`]); zero if nothing was timed.
    pub ms: [f64; 3],
    /// Peak of the device measured right after the frame, in billions of operations per second.
    pub peak_gflops: Option<f64>,
}

impl Timed {
    fn of(frame: &Frame) -> Self {
        let mut ms = [0.0; 3];
        for (pass, time) in &frame.passes {
            ms[Tracing::of_pass(pass).unwrap_or(Tracing::No) as usize] += time;
        }
        Self { ms, peak_gflops: frame.peak_gflops }
    }
}

fn positive(value: &f64) -> bool {
    *value > 0.0 && value.is_finite()
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let values: Vec<_> = values.collect();
    (!values.is_empty()).then(|| Spread::of(values).median)
}

/// Peak of this device and the shares of it that passes reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Measured peak in billions of operations per second.
    pub peak_gflops: f64,
    /// Shares of the peak by class of passes ([`Tracing`]), medians over frames.
    pub shares: [f64; 3],
}

impl Calibration {
    /// Calibrates from the given frames.
    ///
    /// # Errors
    /// Fails with the missing measurement, if the peak or the times of a class are unknown.
    pub fn of<'c>(cells: impl Iterator<Item = &'c Cell> + Clone) -> Result<Self, String> {
        let peak_gflops = median(cells.clone().flat_map(Cell::peaks))
            .ok_or("the device's peak could not be measured, as it has no timestamps")?;
        let mut shares = [0.0; 3];
        for class in Tracing::ALL {
            shares[class as usize] = median(cells.clone().filter_map(|cell| cell.share(class)))
                .ok_or_else(|| format!("no frame has times of {}", class_name(class)))?;
        }
        Ok(Self { peak_gflops, shares })
    }

    /// Predicted milliseconds of a frame on this device at the given peak.
    fn ms(&self, cell: &Cell, peak_gflops: f64) -> f64 {
        let parts = cell.loads.iter().zip(self.shares);
        parts.map(|(load, share)| load.operations / (share * peak_gflops) * 1e-6).sum()
    }
}

/// A frame predicted from the other scenes, and its measured time.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Name of the scene.
    pub scene: String,
    /// Label of the setting.
    pub method: String,
    /// Milliseconds predicted from the other scenes.
    pub predicted_ms: f64,
    /// Measured milliseconds, the sum of the passes.
    pub measured_ms: f64,
}

impl Check {
    /// Ratio of prediction and measurement, whichever way is at least 1.
    pub fn factor(&self) -> f64 {
        (self.predicted_ms / self.measured_ms).max(self.measured_ms / self.predicted_ms)
    }
}

/// Predicts every timed frame from the frames of the other scenes; empty with one scene.
pub fn leave_one_out(cells: &[Cell]) -> Vec<Check> {
    let checks = cells.iter().filter_map(|cell| {
        let (measured_ms, peak_gflops) = cell.measured()?;
        let others = cells.iter().filter(|other| other.scene != cell.scene);
        let calibration = Calibration::of(others).ok()?;
        Some(Check {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            predicted_ms: calibration.ms(cell, peak_gflops),
            measured_ms,
        })
    });
    checks.collect()
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// A frame with the given operations, proportional bytes, and milliseconds by class, on a device with a
    /// peak of 100 billion operations per second.
    pub fn cell(scene: &str, method: &str, operations: [f64; 3], ms: [f64; 3]) -> Cell {
        let load = |operations: f64| Demand {
            operations,
            scene_bytes: 0.2 * operations,
            frame_bytes: 0.01 * operations,
        };
        Cell {
            scene: scene.to_owned(),
            method: method.to_owned(),
            loads: operations.map(load),
            frames: vec![Timed { ms, peak_gflops: Some(100.0) }],
            rays: 10_000_000,
            node_visits: 60_000_000,
            primitive_tests: 30_000_000,
            pixels: 4_000_000,
        }
    }

    /// Two scenes, of which the second takes twice the time for its work.
    pub fn scenes() -> Vec<Cell> {
        vec![
            cell("a", "full", [40e9, 0.0, 0.0], [2000.0, 0.0, 0.0]),
            cell("a", "adaptive", [10e9, 5e9, 4e9], [500.0, 500.0, 100.0]),
            cell("b", "full", [20e9, 0.0, 0.0], [2000.0, 0.0, 0.0]),
            cell("b", "adaptive", [5e9, 2e9, 4e9], [500.0, 400.0, 200.0]),
        ]
    }

    #[test]
    fn shares_are_rates_over_the_peak() {
        let cells = scenes();
        let calibration = Calibration::of(cells[..2].iter()).expect("calibrated");
        // 20, 10 and 40 billion operations per second of 100.
        assert_eq!(calibration, Calibration { peak_gflops: 100.0, shares: [0.2, 0.1, 0.4] });
    }

    #[test]
    fn a_scene_is_predicted_from_the_others() {
        let checks = leave_one_out(&scenes());
        assert_eq!(checks.len(), 4);
        assert_eq!((checks[0].predicted_ms, checks[0].measured_ms), (4000.0, 2000.0));
        assert_eq!((checks[2].predicted_ms, checks[2].measured_ms), (1000.0, 2000.0));
        assert!(checks.iter().all(|check| (check.factor() - 2.0).abs() < 1e-9), "{checks:?}");
        assert_eq!(leave_one_out(&scenes()[..2]), [], "nothing was left to predict from");
    }

    /// A frame that takes twice the time at half the peak gives the same share.
    #[test]
    fn each_frame_counts_against_the_peak_of_its_own_moment() {
        let mut cells = scenes()[..2].to_vec();
        let slow = |frame: &Timed| Timed { ms: frame.ms.map(|ms| 2.0 * ms), peak_gflops: Some(50.0) };
        cells[1].frames = cells[1].frames.iter().map(slow).collect();
        assert_eq!(Calibration::of(cells.iter()).expect("calibrated").shares, [0.2, 0.1, 0.4]);
    }

    #[test]
    fn without_times_there_is_no_calibration() {
        let untimed: Vec<_> = scenes()
            .into_iter()
            .map(|cell| Cell { frames: vec![Timed { ms: [0.0; 3], peak_gflops: Some(100.0) }], ..cell })
            .collect();
        let error = Calibration::of(untimed.iter()).expect_err("no times");
        assert!(error.contains("traced neighbours"), "{error}");
        let frames = vec![Timed { ms: [1.0; 3], peak_gflops: None }];
        let unmeasured = scenes().into_iter().map(|cell| Cell { frames: frames.clone(), ..cell });
        let unmeasured: Vec<_> = unmeasured.collect();
        assert!(Calibration::of(unmeasured.iter()).expect_err("no peak").contains("no timestamps"));
        let traced_fully: Vec<_> = scenes().into_iter().filter(|cell| cell.method == "full").collect();
        assert!(Calibration::of(traced_fully.iter()).expect_err("no lists").contains("traced lists"));
        assert_eq!(leave_one_out(&untimed), []);
    }
}

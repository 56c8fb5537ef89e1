//! The shares of its peak that this device reaches, from the times of its passes; and how well they predict a scene that
//! they were not taken from.

use glimpse::{Demand, Tracing};
use glimpse_measure::statistics::Spread;

use crate::bench::Measured;
use crate::record::Frame;
use crate::work::class_name;

/// A frame that was counted and timed.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The scene's name.
    pub scene: String,
    /// The setting's label.
    pub method: String,
    /// By [`Tracing`].
    pub loads: [Demand; 3],
    /// The timed ones.
    pub frames: Vec<Timed>,
    /// All of them.
    pub rays: u64,
    /// Of the acceleration structure.
    pub node_visits: u64,
    /// Of triangles and spheres.
    pub primitive_tests: u64,
    /// Of the frame.
    pub pixels: u64,
}

impl Cell {
    /// The frames of a measurement whose work was counted.
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

    /// Of the whole frame.
    pub fn operations(&self) -> f64 {
        self.loads.iter().map(|load| load.operations).sum()
    }

    /// The share of the peak that a class of passes reaches: the median over frames, each against the peak of its own moment, so
    /// that what else the device does counts on both sides. None where nothing was timed.
    fn share(&self, class: Tracing) -> Option<f64> {
        let operations = self.loads[class as usize].operations;
        let shares = self.frames.iter().filter_map(|frame| {
            let share = operations / frame.ms[class as usize] * 1e-6 / frame.peak_gflops?;
            positive(&share).then_some(share)
        });
        median(shares)
    }

    /// Median milliseconds of all passes, and the device's peak at the time.
    fn measured(&self) -> Option<(f64, f64)> {
        let ms = self.frames.iter().map(|frame| frame.ms.iter().sum()).filter(positive);
        median(ms).zip(median(self.peaks()))
    }

    fn peaks(&self) -> impl Iterator<Item = f64> {
        self.frames.iter().filter_map(|frame| frame.peak_gflops).filter(positive)
    }
}

/// The time of a frame.
#[derive(Clone, Debug)]
pub struct Timed {
    /// Milliseconds by [`Tracing`]; zero where nothing was timed.
    pub ms: [f64; 3],
    /// Billions of operations a second, measured right after it.
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

/// What this device reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Measured, billions of operations a second.
    pub peak_gflops: f64,
    /// Shares of it by [`Tracing`], medians over frames.
    pub shares: [f64; 3],
}

impl Calibration {
    /// From these frames.
    ///
    /// # Errors
    /// Says what is missing where they do not tell: never a number that nothing was measured for.
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

    /// What a frame would take on this device while its peak is that.
    fn ms(&self, cell: &Cell, peak_gflops: f64) -> f64 {
        let parts = cell.loads.iter().zip(self.shares);
        parts.map(|(load, share)| load.operations / (share * peak_gflops) * 1e-6).sum()
    }
}

/// A frame of a scene that the calibration has not seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// The scene's name.
    pub scene: String,
    /// The setting's label.
    pub method: String,
    /// From the other scenes.
    pub predicted_ms: f64,
    /// The sum of its passes.
    pub measured_ms: f64,
}

impl Check {
    /// How many times too long or too short, at least 1.
    pub fn factor(&self) -> f64 {
        (self.predicted_ms / self.measured_ms).max(self.measured_ms / self.predicted_ms)
    }
}

/// Every timed frame, predicted from the frames of the other scenes; none where there is one scene.
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

    /// A frame of so many operations and milliseconds, with bytes to match, on a device of 100 billion a second.
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

    /// Two scenes, the second of which takes twice as long for its work.
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
        // 20, 10 and 40 billion a second of 100.
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

    /// A frame that took twice as long while the device did half as much says the same.
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

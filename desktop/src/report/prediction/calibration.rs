//! The shares of its peak that this device reaches, from the times of its passes; and how well they predict a scene that
//! they were not taken from.

use glimpse::Demand;

use super::work::Kind;
use crate::report::bench::Measured;
use crate::statistics::Spread;

/// A frame that was counted and timed.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The scene's name.
    pub scene: String,
    /// The setting's label.
    pub method: String,
    /// By [`Kind`].
    pub loads: [Demand; 3],
    /// Median milliseconds by [`Kind`]; zero where nothing was timed.
    pub ms: [f64; 3],
    /// Measured with it.
    pub peak_gflops: Option<f64>,
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
            let mut ms = [0.0; 3];
            for (pass, time) in record.passes() {
                ms[Kind::of(pass) as usize] += time;
            }
            Some(Self {
                scene: scene.to_owned(),
                method: rung.name.clone(),
                loads: work.loads,
                ms,
                peak_gflops: work.peak_gflops,
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

    fn measured_ms(&self) -> f64 {
        self.ms.iter().sum()
    }
}

/// What this device reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Measured, billions of operations a second.
    pub peak_gflops: f64,
    /// Shares of it by [`Kind`], medians over frames.
    pub shares: [f64; 3],
}

impl Calibration {
    /// From these frames.
    ///
    /// # Errors
    /// Says what is missing where they do not tell: never a number that nothing was measured for.
    pub fn of<'c>(cells: impl Iterator<Item = &'c Cell> + Clone) -> Result<Self, String> {
        let peaks: Vec<_> = cells.clone().filter_map(|cell| cell.peak_gflops).filter(positive).collect();
        if peaks.is_empty() {
            return Err("the device's peak could not be measured, as it has no timestamps".to_owned());
        }
        let peak_gflops = Spread::of(peaks).median;
        let mut shares = [0.0; 3];
        for kind in Kind::ALL {
            let rates = cells.clone().filter_map(|cell| {
                let (operations, ms) = (cell.loads[kind as usize].operations, cell.ms[kind as usize]);
                (positive(&operations) && positive(&ms)).then(|| operations / ms * 1e-6)
            });
            let rates: Vec<_> = rates.collect();
            if rates.is_empty() {
                return Err(format!("no frame has times of {}", kind.name()));
            }
            shares[kind as usize] = Spread::of(rates).median / peak_gflops;
        }
        Ok(Self { peak_gflops, shares })
    }

    /// What a frame would take on this device.
    fn ms(&self, cell: &Cell) -> f64 {
        let parts = cell.loads.iter().zip(self.shares);
        parts.map(|(load, share)| load.operations / (share * self.peak_gflops) * 1e-6).sum()
    }
}

fn positive(value: &f64) -> bool {
    *value > 0.0 && value.is_finite()
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
    let checks = cells.iter().filter(|cell| positive(&cell.measured_ms())).filter_map(|cell| {
        let others = cells.iter().filter(|other| other.scene != cell.scene);
        let calibration = Calibration::of(others).ok()?;
        Some(Check {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            predicted_ms: calibration.ms(cell),
            measured_ms: cell.measured_ms(),
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
            ms,
            peak_gflops: Some(100.0),
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

    #[test]
    fn without_times_there_is_no_calibration() {
        let untimed: Vec<_> = scenes().into_iter().map(|cell| Cell { ms: [0.0; 3], ..cell }).collect();
        let error = Calibration::of(untimed.iter()).expect_err("no times");
        assert!(error.contains("traced neighbours"), "{error}");
        let unmeasured: Vec<_> =
            scenes().into_iter().map(|cell| Cell { peak_gflops: None, ..cell }).collect();
        assert!(Calibration::of(unmeasured.iter()).expect_err("no peak").contains("no timestamps"));
        let traced_fully: Vec<_> = scenes().into_iter().filter(|cell| cell.method == "full").collect();
        assert!(Calibration::of(traced_fully.iter()).expect_err("no lists").contains("traced lists"));
        assert_eq!(leave_one_out(&untimed), []);
    }
}

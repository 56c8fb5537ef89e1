//! Stored measurements: a setting of a scene, its frame times and its error.

use glimpse::metrics::ErrorReport;
use glimpse::{FrameTime, Inspection, Missing};
use glimpse_measure::machine;
use glimpse_measure::statistics::Spread;
use serde::{Deserialize, Serialize};

use crate::interval::Estimate;
use crate::work::Work;

/// Measurement of one setting, as it is stored.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Record {
    /// Identity as text: [`crate::identity::Identity::line`].
    pub identity: String,
    /// Number of pixels of the shown picture.
    pub pixels: u64,
    /// Number of rays of a frame, of all kinds.
    pub rays: u64,
    /// RT ratio of Kim 2016: traced samples over all samples.
    pub rt_ratio: f64,
    /// Share of samples whose first hit is on a reflective surface.
    pub reflective_share: f64,
    /// Error against the reference; `None` for the reference itself.
    pub error: Option<ErrorReport>,
    /// Error against the picture of the first setting as well; `None` unless the job asks for it.
    pub error_of_first: Option<ErrorReport>,
    /// Objects and pixels that full ray tracing shows and this setting loses; `None` unless the job counts
    /// them.
    pub missing: Option<Missing>,
    /// Operations and bytes of the frame; `None` unless the job counts them.
    pub work: Option<Work>,
    /// Day of the measurement in UTC, as `2026-01-31`.
    pub day: String,
    /// Timed frames.
    pub frames: Vec<Frame>,
}

/// Time of one frame.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Frame {
    /// Milliseconds of the whole frame.
    pub ms: f64,
    /// Milliseconds of the job's control frame that was timed right before; `None` in jobs without a control.
    pub control_ms: Option<f64>,
    /// Milliseconds of each pass, in order.
    pub passes: Vec<(String, f64)>,
    /// Peak of the device measured right after the frame, in billions of operations per second; `None`
    /// without timestamps or unless the job counts work.
    pub peak_gflops: Option<f64>,
}

impl Frame {
    /// Scales the time to a picture that accumulates `frames` such frames.
    pub fn times(self, frames: f64) -> Self {
        let passes = self.passes.into_iter().map(|(name, ms)| (name, frames * ms)).collect();
        Self { ms: frames * self.ms, passes, ..self }
    }
}

impl From<FrameTime> for Frame {
    fn from(time: FrameTime) -> Self {
        let passes = time.passes.into_iter().map(|p| (p.name.to_owned(), p.ms)).collect();
        Self { ms: time.ms, control_ms: None, passes, peak_gflops: None }
    }
}

impl Record {
    /// Creates a record without timed frames. `reflects` says for each object whether its surface reflects.
    pub fn new(
        identity: String,
        [width, height]: [u32; 2],
        inspection: &Inspection,
        reflects: &[bool],
        error: Option<ErrorReport>,
    ) -> Self {
        let on_mirror = |object: Option<u32>| object.is_some_and(|o| reflects.get(o as usize) == Some(&true));
        let mirrors = inspection.pixels.iter().filter(|p| on_mirror(p.object)).count();
        Self {
            identity,
            pixels: u64::from(width) * u64::from(height),
            rays: inspection.counts.rays.total,
            rt_ratio: inspection.counts.rt_ratio(),
            reflective_share: mirrors as f64 / inspection.pixels.len().max(1) as f64,
            error,
            error_of_first: None,
            missing: None,
            work: None,
            day: machine::today(),
            frames: Vec::new(),
        }
    }

    /// Median and 95th percentile of the frame times in milliseconds.
    pub fn time(&self) -> Spread {
        Spread::of(self.frames.iter().map(|f| f.ms))
    }

    /// Logarithm of each frame's time: of its ratio to the control frame of the same round, where the job has a control.
    pub fn log_times(&self) -> Vec<f64> {
        self.frames.iter().map(|frame| (frame.ms / frame.control_ms.unwrap_or(1.0)).ln()).collect()
    }

    /// The 95 % confidence interval of the times, scaled so that their geometric mean is at the median in milliseconds;
    /// `None` for fewer than two frames.
    pub fn interval_ms(&self) -> Option<[f64; 2]> {
        let estimate = Estimate::of_logarithms(&self.log_times());
        let scale = self.time().median / estimate.mean;
        estimate.interval.map(|interval| interval.map(|end| scale * end))
    }

    /// Median milliseconds of each pass, in the order of the first frame.
    pub fn passes(&self) -> Vec<(&str, f64)> {
        let Some(first) = self.frames.first() else { return Vec::new() };
        let times = |name| self.frames.iter().flat_map(move |f| f.passes.iter().filter(move |p| p.0 == name));
        let names = first.passes.iter().map(|(name, _)| name.as_str());
        names.map(|name| (name, Spread::of(times(name).map(|p| p.1)).median)).collect()
    }

    /// Rays of all kinds per shown pixel.
    pub fn rays_per_pixel(&self) -> f64 {
        self.rays as f64 / self.pixels as f64
    }

    /// PSNR in decibels, infinite for equal pictures; `None` for a reference.
    pub fn psnr_db(&self) -> Option<f64> {
        self.error.map(|error| error.psnr_db.unwrap_or(f64::INFINITY))
    }

    /// Efficiency 1 / (MSE x seconds), with the mean squared error of display values in [0, 1]. Twice the
    /// time for half the squared error leaves it unchanged; infinite for equal pictures.
    pub fn efficiency(&self) -> Option<f64> {
        self.error.map(|error| 1e3 / ((error.rmse / 255.0).powi(2) * self.time().median))
    }
}

#[cfg(test)]
pub mod tests {
    use glimpse::{Counts, Origin, PixelRecord, Rays, Samples};

    use super::*;

    /// A record with one frame of `ms` milliseconds, 100 pixels, 340 rays and the given PSNR.
    pub fn example(identity: &str, ms: f64, psnr_db: Option<f64>) -> Record {
        let error = |db: f64| ErrorReport {
            rmse: 255.0 * 10_f64.powf(-db / 20.0),
            psnr_db: db.is_finite().then_some(db),
            ssim: 0.99,
            flip_mean: Some(0.01),
            flip_p99: Some(0.1),
            worst_tile_rmse: 9.0,
            worst_tile: [8, 0],
            linear_rmse: None,
        };
        Record {
            identity: identity.to_owned(),
            pixels: 100,
            rays: 340,
            rt_ratio: 0.34,
            reflective_share: 0.25,
            error: psnr_db.map(error),
            error_of_first: None,
            missing: None,
            work: None,
            day: "2026-01-31".to_owned(),
            frames: vec![Frame {
                ms,
                control_ms: None,
                passes: vec![("base".into(), 0.75 * ms), ("trace_a1".into(), 0.25 * ms)],
                peak_gflops: None,
            }],
        }
    }

    #[test]
    fn efficiency_is_one_over_error_times_time() {
        // 20 dB: an RMSE of a tenth, an MSE of a hundredth; 0.5 s.
        let record = example("r", 500.0, Some(20.0));
        assert!((record.efficiency().unwrap() - 200.0).abs() < 1e-9);
        let (half_error, double_time) = (example("r", 1000.0, Some(20.0 + 10.0 * 2_f64.log10())), 200.0);
        assert!((half_error.efficiency().unwrap() - double_time).abs() < 1e-9);
        assert_eq!(example("r", 500.0, None).efficiency(), None);
        let equal = example("r", 500.0, Some(f64::INFINITY));
        assert_eq!((equal.efficiency(), equal.psnr_db()), (Some(f64::INFINITY), Some(f64::INFINITY)));
    }

    #[test]
    fn times_are_medians_over_the_frames() {
        let mut record = example("r", 1.0, None);
        record.frames.extend([5.0, 3.0].map(|ms| example("r", ms, None).frames.remove(0)));
        assert_eq!(record.time(), Spread { median: 3.0, p95: 5.0 });
        let [low, high] = record.interval_ms().unwrap();
        let half = Estimate::of_logarithms(&record.log_times()).interval.unwrap()[1];
        assert!(
            (low * high - 9.0).abs() < 1e-9 && high > half && low < 3.0,
            "around the median: {low} {high}"
        );
        assert_eq!(record.passes(), [("base", 2.25), ("trace_a1", 0.75)]);
        assert!((record.rays_per_pixel() - 3.4).abs() < 1e-12);
    }

    #[test]
    fn mirrors_are_counted_by_what_is_seen_first() {
        let pixel = |object| PixelRecord {
            active: 0,
            differing: 0,
            strata: 0,
            origin: Origin::Base,
            failed: 0,
            cost: 0,
            object,
            depth: 1.0,
            normal: [0.0; 3],
        };
        let counts = Counts {
            rays: Rays { total: 12, ..Rays::default() },
            samples: Samples { total: 4, base: 1, traced_a1: 1, ..Samples::default() },
            ..Counts::default()
        };
        let pixels = [Some(0), Some(1), Some(1), None].map(pixel).to_vec();
        let record = Record::new(
            "r".into(),
            [2, 2],
            &Inspection { counts, pixels, uncorrected: 0 },
            &[false, true],
            None,
        );
        assert_eq!((record.reflective_share, record.rt_ratio, record.rays_per_pixel()), (0.5, 0.5, 3.0));
    }
}

//! The statistics JSON: what was rendered, with what, how long it took and what it cost.

use glimpse::metrics::ErrorReport;
use glimpse::{Cost, FailedChecks, FrameTime, Memory, Missing, Rays, Samples, Settings, Tracing};
use glimpse_measure::statistics::{AdapterStatistics, SceneStatistics, Spread};
use serde::Serialize;

use crate::cpu_tracer::Sides;
use crate::measure::{Run, Workbench};
use crate::pan::PanStatistics;

/// One method on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Statistics {
    /// This program's version.
    pub glimpse: &'static str,
    /// Where it ran.
    pub adapter: AdapterStatistics,
    /// What was rendered.
    pub scene: SceneStatistics,
    /// Every option as it was used.
    pub settings: SettingsUsed,
    /// Width and height.
    pub size: [u32; 2],
    /// Timed frames.
    pub frames: usize,
    /// How long it took.
    pub time_ms: Times,
    /// Rays by kind.
    pub rays: Rays,
    /// Samples by origin.
    pub samples: Samples,
    /// Kim 2016's RT ratio.
    pub rt_ratio: f64,
    /// Work of the traversal.
    pub cost: Cost,
    /// Samples by check that they fail.
    pub failed_checks: FailedChecks,
    /// Bytes on the device.
    pub memory_bytes: Memory,
    /// Millions of this method's own rays in a second of its median frame.
    pub mrays_per_s: f64,
    /// The part of the frame spent in passes that trace nothing; null where passes are not timed.
    pub non_tracing_share: Option<f64>,
    /// Against `full` of the same run.
    #[serde(flatten)]
    pub gain: Option<Gain>,
    /// The error against `full` of the same run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorAgainst>,
    /// What `full` of the same run shows and this frame does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<Missing>,
    /// The frames of a camera that turned, where it did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pan: Option<PanStatistics>,
    /// Who brought the samples of paths after the timed frames, where there were any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sides: Option<Sides>,
}

/// The settings and the camera.
#[derive(Clone, Debug, Serialize)]
pub struct SettingsUsed {
    /// What the renderer was told.
    #[serde(flatten)]
    pub settings: Settings,
    /// Index and name.
    pub camera: String,
}

/// Milliseconds.
#[derive(Clone, Debug, Serialize)]
pub struct Times {
    /// A whole frame.
    pub frame: Spread,
    /// `gpu` where timestamps measured the frame, else `cpu`.
    pub clock: &'static str,
    /// Each pass.
    pub passes: Vec<PassMedian>,
    /// Reading the scene.
    pub load: f64,
    /// Building the acceleration structure and moving everything to the device.
    pub build: f64,
    /// Compiling the kernels, with the first frame, in which drivers finish compiling.
    pub compile: f64,
}

/// The time of a pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassMedian {
    /// Its name.
    pub name: &'static str,
    /// Whether it traces rays.
    pub tracing: Tracing,
    /// Over the frames.
    pub median: f64,
}

/// What a method gains over `full`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gain {
    /// Full frame's time over this method's.
    pub speedup: f64,
    /// `speedup` x RT ratio: 1 where saved samples are saved time.
    pub efficiency: f64,
    /// `speedup` x traced share of the cost: 1 where saved work is saved time.
    pub cost_efficiency: f64,
}

/// An error with its reference.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ErrorAgainst {
    /// The reference's method.
    pub against: &'static str,
    /// The measures.
    #[serde(flatten)]
    pub report: ErrorReport,
}

impl Statistics {
    /// Of one run, and against the full frame where there is one.
    pub fn of(workbench: &Workbench<'_>, run: &Run, full: Option<&Run>) -> glimpse::Result<Self> {
        let counts = run.inspection.counts;
        let frame = Spread::of(run.frames.iter().map(|f| f.ms));
        let passes = pass_medians(&run.frames);
        let share = full.and_then(|full| traced_share(&counts.cost, &full.inspection.counts.cost));
        let gain = full.map(|full| {
            let speedup = Spread::of(full.frames.iter().map(|f| f.ms)).median / frame.median;
            Gain {
                speedup,
                efficiency: speedup * counts.rt_ratio(),
                cost_efficiency: speedup * share.unwrap_or(f64::NAN),
            }
        });
        Ok(Self {
            glimpse: env!("CARGO_PKG_VERSION"),
            adapter: AdapterStatistics::of(&workbench.gpu.facts().info),
            scene: workbench.statistics.clone().linked(workbench.scene.features(), run.settings.specialize),
            settings: SettingsUsed { settings: run.settings, camera: workbench.camera_name.clone() },
            size: run.picture.dimensions().into(),
            frames: run.frames.len(),
            mrays_per_s: counts.rays.total as f64 / (1000.0 * frame.median),
            non_tracing_share: non_tracing_share(&passes, frame.median),
            time_ms: Times {
                frame,
                clock: if workbench.gpu.facts().timestamps { "gpu" } else { "cpu" },
                passes,
                load: workbench.load_ms,
                build: workbench.build_ms,
                compile: run.compile_ms,
            },
            rays: counts.rays,
            samples: counts.samples,
            rt_ratio: counts.rt_ratio(),
            cost: Cost { traced_share: share, ..counts.cost },
            failed_checks: counts.failed_checks,
            memory_bytes: run.memory,
            gain,
            error: full.map(|full| run.error_against(full)).transpose()?,
            pan: run.panned.as_ref().map(PanStatistics::of),
            sides: run.sides.clone(),
            // Of pixels that were kept from an earlier frame the object is not known.
            missing: full
                .filter(|_| !run.settings.method.has_history())
                .and_then(|full| Missing::of(&full.inspection.pixels, &run.inspection.pixels)),
        })
    }
}

/// The median of each pass, in the order of the first frame.
pub fn pass_medians(frames: &[FrameTime]) -> Vec<PassMedian> {
    let Some(first) = frames.first() else { return Vec::new() };
    let times = |name: &'static str| {
        frames.iter().filter_map(move |frame| frame.passes.iter().find(|p| p.name == name)).map(|p| p.ms)
    };
    first
        .passes
        .iter()
        .map(|pass| PassMedian {
            name: pass.name,
            tracing: pass.tracing,
            median: Spread::of(times(pass.name)).median,
        })
        .collect()
}

/// The part of a frame spent in passes that trace nothing.
pub fn non_tracing_share(passes: &[PassMedian], frame_ms: f64) -> Option<f64> {
    let other = passes.iter().filter(|p| p.tracing == Tracing::No);
    (!passes.is_empty() && frame_ms > 0.0).then(|| other.map(|p| p.median).sum::<f64>() / frame_ms)
}

/// The part of the full frame's work that `method` did: what lies in the samples that it traced.
pub fn traced_share(method: &Cost, full: &Cost) -> Option<f64> {
    let work = |cost: &Cost| (cost.node_visits + cost.primitive_tests) as f64;
    (work(full) > 0.0).then(|| work(method) / work(full))
}

#[cfg(test)]
#[path = "statistics_tests.rs"]
pub mod tests;

//! The statistics JSON: settings, times, counters and errors of a frame.

use glimpse::metrics::ErrorReport;
use glimpse::scene::NotShown;
use glimpse::{Cost, FailedChecks, FrameTime, Memory, Missing, Rays, Samples, Settings, Tracing};
use glimpse_measure::statistics::{AdapterStatistics, SceneStatistics, Spread};
use serde::Serialize;

use crate::cpu_tracer::Sides;
use crate::measure::{Run, Workbench};
use crate::pan::PanStatistics;

/// Measurements of one method on one scene.
#[derive(Clone, Debug, Serialize)]
pub struct Statistics {
    /// Version of Glimpse.
    pub glimpse: &'static str,
    /// Adapter that rendered.
    pub adapter: AdapterStatistics,
    /// Contents of the scene.
    pub scene: SceneStatistics,
    /// What the import left out or replaced: one sentence each.
    pub warnings: Vec<String>,
    /// Features of the file that the picture does not show as the format has it.
    pub not_shown: Vec<NotShown>,
    /// Values of all options.
    pub settings: SettingsUsed,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Number of timed frames.
    pub frames: usize,
    /// Times in milliseconds.
    pub time_ms: Times,
    /// Number of rays by kind.
    pub rays: Rays,
    /// Number of samples by origin.
    pub samples: Samples,
    /// RT ratio of Kim 2016: traced samples over all samples.
    pub rt_ratio: f64,
    /// Work of the traversal.
    pub cost: Cost,
    /// Number of samples by failed similarity check.
    pub failed_checks: FailedChecks,
    /// Bytes of device memory.
    pub memory_bytes: Memory,
    /// Millions of rays of this method per second of its median frame.
    pub mrays_per_s: f64,
    /// Share of the frame time spent in passes that trace no rays; null if passes are not timed.
    pub non_tracing_share: Option<f64>,
    /// Gain over `full` of the same run.
    #[serde(flatten)]
    pub gain: Option<Gain>,
    /// Error against `full` of the same run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorAgainst>,
    /// Objects and pixels that `full` of the same run shows and this frame loses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<Missing>,
    /// Summary of the frames of a panning camera, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pan: Option<PanStatistics>,
    /// Samples by GPU and CPU thread after the timed frames, for path tracing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sides: Option<Sides>,
}

/// Settings and camera of the frame.
#[derive(Clone, Debug, Serialize)]
pub struct SettingsUsed {
    /// Settings of the renderer.
    #[serde(flatten)]
    pub settings: Settings,
    /// Index and name of the camera.
    pub camera: String,
}

/// Times in milliseconds.
#[derive(Clone, Debug, Serialize)]
pub struct Times {
    /// Time of a whole frame.
    pub frame: Spread,
    /// `gpu` if timestamps measured the frame, else `cpu`.
    pub clock: &'static str,
    /// Median time of each pass.
    pub passes: Vec<PassMedian>,
    /// Time to load the scene.
    pub load: f64,
    /// Time to build the acceleration structure and upload the scene.
    pub build: f64,
    /// Time to compile the kernels and render the first frame, in which drivers finish compiling.
    pub compile: f64,
}

/// Median time of a pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PassMedian {
    /// Name of the pass.
    pub name: &'static str,
    /// Class of the pass: whether and how it traces rays.
    pub tracing: Tracing,
    /// Median in milliseconds over the frames.
    pub median: f64,
}

/// Gain of a method over `full`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gain {
    /// Median frame time of `full` over that of this method.
    pub speedup: f64,
    /// `speedup` x RT ratio: 1 if the time saved is proportional to the samples saved.
    pub efficiency: f64,
    /// `speedup` x traced share of the cost: 1 if the time saved is proportional to the work saved.
    pub cost_efficiency: f64,
}

/// Error of a picture with the name of its reference.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ErrorAgainst {
    /// Method of the reference.
    pub against: &'static str,
    /// Error metrics.
    #[serde(flatten)]
    pub report: ErrorReport,
}

impl Statistics {
    /// Statistics of a run; gain, error and missing objects are against the run of `full`, if there is one.
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
            warnings: workbench.warnings.clone(),
            not_shown: workbench.not_shown.clone(),
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
            // The objects of pixels reused from an earlier frame are unknown.
            missing: full
                .filter(|_| !run.settings.method.has_history())
                .and_then(|full| Missing::of(&full.inspection.pixels, &run.inspection.pixels)),
        })
    }
}

/// Median time of each pass, in the order of the first frame.
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

/// Share of a frame's time spent in passes that trace no rays.
pub fn non_tracing_share(passes: &[PassMedian], frame_ms: f64) -> Option<f64> {
    let other = passes.iter().filter(|p| p.tracing == Tracing::No);
    (!passes.is_empty() && frame_ms > 0.0).then(|| other.map(|p| p.median).sum::<f64>() / frame_ms)
}

/// Node visits and primitive tests of a method over those of `full`.
pub fn traced_share(method: &Cost, full: &Cost) -> Option<f64> {
    let work = |cost: &Cost| (cost.node_visits + cost.primitive_tests) as f64;
    (work(full) > 0.0).then(|| work(method) / work(full))
}

#[cfg(test)]
#[path = "statistics_tests.rs"]
pub mod tests;

//! Divides a frame into dispatches, and groups these into submissions that are too short for the driver's
//! watchdog.
//!
//! Drivers reset a device that works on one submission for too long: after 2 s on Windows (Microsoft, "Timeout
//! detection and recovery (TDR)"), after 0.5 s under Linux on Mali (`JOB_TIMEOUT_MS`, panfrost) and Adreno
//! (`DRM_MSM_HANGCHECK_DEFAULT_PERIOD`, msm). A slow phone traces 10 million rays a second, and a sample takes
//! about 4 (primary, shadows, one or two bounces). [`SAMPLES_PER_SUBMISSION`] samples take 0.1 s there, a fifth
//! of the strictest limit.

use crate::passes::{FrameSpec, Recipe, Stage, TRACE_GROUP, Tracing};

mod bands;
#[cfg(test)]
mod tests;

use bands::bands;
pub use bands::{Band, band_rows};

/// The most samples that one submission traces. A larger number makes submissions longer and gaps between them
/// fewer.
///
/// A frame of fewer samples (450x450 by either method) is one submission. A row of workgroups is never divided,
/// so the limit is exceeded from 32,768 pixels of width on.
pub const SAMPLES_PER_SUBMISSION: u32 = 1 << 18;

/// Pixels that an interpolating pass processes in the time of one traced sample (measured: interpolating 3/4 of
/// the pixels takes 13 % of a frame's time, tracing 31 % of them takes 87 %).
const INTERPOLATED_PER_TRACED: u32 = 16;

/// The rows of samples that a stage processes: every `stride`-th one in `row..end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// Distance of neighbouring references in samples, along both axes.
    pub stride: u32,
    /// First row.
    pub row: u32,
    /// Row after the last one.
    pub end: u32,
    /// Row at which the band's storage is folded ([`Band::turn`]).
    pub turn: u32,
}

impl Rows {
    /// Number of rows.
    pub fn count(&self) -> u32 {
        self.end.saturating_sub(self.row).div_ceil(self.stride)
    }
}

/// One dispatch of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// The stage whose kernel runs.
    pub stage: &'static Stage,
    /// The rows of samples that it processes.
    pub rows: Rows,
    /// Index of its pass in the frame.
    pub pass: usize,
    /// Where the dispatch starts in its pass: a row of workgroups, or an index into the list.
    pub first: u32,
    /// Offset in samples from one sample to the next: of a scan, or of the taps of a filter.
    pub step: [i32; 2],
    /// The most samples that one thread of the postcorrection traces.
    pub walk: u32,
    /// Number of workgroups.
    pub extent: Extent,
    /// Whether this is the first and whether it is the last dispatch of its pass.
    pub bounds: [bool; 2],
    /// The most samples that it traces; for other work, as many as would take the same time.
    pub samples: u32,
}

impl Part {
    /// A pass of one workgroup that traces nothing.
    pub fn whole(stage: &'static Stage, rows: Rows) -> Self {
        Self {
            stage,
            rows,
            pass: 0,
            first: 0,
            step: [0; 2],
            walk: 0,
            extent: Extent::Groups([1, 1]),
            bounds: [true, true],
            samples: 0,
        }
    }

    /// Index of the a-trous buffer that this dispatch writes; the levels of the filter alternate between two.
    pub fn filtered(&self) -> usize {
        // The first level reads the buffer that the preparing pass, which has no step, wrote.
        usize::from(self.step[0] != 0 && self.step[0].trailing_zeros().is_multiple_of(2))
    }
}

/// How many workgroups a dispatch has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// A fixed number along x and y.
    Groups([u32; 2]),
    /// As many as the chunk of this index in the list needs, dispatched indirectly.
    Chunk(u32),
    /// As many as trace the frame's share of this many tiles of ranks.
    Refreshed(u32),
}

/// All dispatches of a frame, in order of execution.
pub struct Plan {
    /// Samples of the frame across and down.
    pub grid: [u32; 2],
    /// The dispatches, in order of execution.
    pub parts: Vec<Part>,
    /// Rows of samples that are stored at the same time.
    pub stored_rows: u32,
    /// The most entries that the list of one pass may hold.
    longest_list: u32,
}

impl Plan {
    /// Plans a frame of `grid` samples in bands of `band` rows ([`band_rows`]).
    pub fn new(spec: &FrameSpec, grid: [u32; 2], band: u32) -> Self {
        let mut plan = Self { grid, parts: Vec::new(), stored_rows: 0, longest_list: 0 };
        for band in bands(grid[1], band) {
            plan.stored_rows = plan.stored_rows.max(band.end - band.first);
            (Recipe::of(spec.settings.method).plan)(&mut plan, spec, &band);
        }
        plan
    }

    /// Raises the capacity of the list to at least `longest` entries.
    pub fn lists(&mut self, longest: u32) {
        self.longest_list = self.longest_list.max(longest);
    }

    /// Adds a pass that compacts the list of a grid's samples and one that traces the listed samples.
    pub fn traces(&mut self, [compact, trace]: [&'static Stage; 2], columns: u32, rows: Rows) {
        let longest = columns * rows.count();
        self.lists(longest);
        self.push(once(compact, rows));
        self.push(chunks(trace, longest, rows));
    }

    /// Appends the dispatches of one pass.
    pub fn push(&mut self, parts: Vec<Part>) {
        let pass = self.parts.last().map_or(0, |part| part.pass + 1);
        self.parts.extend(parts.into_iter().map(|part| Part { pass, ..part }));
    }

    /// The stage of each pass, in order of execution.
    pub fn passes(&self) -> Vec<&'static Stage> {
        self.parts.chunk_by(|a, b| a.pass == b.pass).map(|parts| parts[0].stage).collect()
    }

    /// Number of chunks of [`SAMPLES_PER_SUBMISSION`] entries in the longest list.
    pub fn chunks(&self) -> u32 {
        self.longest_list.div_ceil(SAMPLES_PER_SUBMISSION).max(1)
    }

    /// Groups the dispatches into submissions; each dispatch comes with its index in `parts`.
    pub fn submissions(&self) -> Vec<Vec<(usize, Part)>> {
        let mut submissions: Vec<Vec<(usize, Part)>> = Vec::new();
        let mut samples = 0;
        for part in self.parts.iter().copied().enumerate() {
            samples += part.1.samples;
            match submissions.last_mut() {
                Some(open) if samples <= SAMPLES_PER_SUBMISSION => open.push(part),
                _ => {
                    samples = part.1.samples;
                    submissions.push(vec![part]);
                }
            }
        }
        submissions
    }
}

/// A pass of a single workgroup.
pub fn once(stage: &'static Stage, rows: Rows) -> Vec<Part> {
    one(stage, rows, [1, 1])
}

/// A pass of a single dispatch of `groups` workgroups that traces nothing.
pub fn one(stage: &'static Stage, rows: Rows, groups: [u32; 2]) -> Vec<Part> {
    vec![Part { extent: Extent::Groups(groups), ..Part::whole(stage, rows) }]
}

/// Samples that the stage processes in the time of one traced sample.
fn per_sample(stage: &Stage) -> u32 {
    if stage.tracing == Tracing::No { INTERPOLATED_PER_TRACED } else { 1 }
}

/// A pass over a grid of samples, divided into dispatches at rows of workgroups; empty if there are no rows.
pub fn tiles(stage: &'static Stage, columns: u32, rows: Rows) -> Vec<Part> {
    let side = stage.work.side();
    let [across, down] = [columns, rows.count()].map(|n| n.div_ceil(side));
    let row_samples = across * side * side / per_sample(stage);
    let height = (SAMPLES_PER_SUBMISSION / row_samples).max(1);
    let part = |first: u32| {
        let count = height.min(down - first);
        Part {
            first,
            extent: Extent::Groups([across, count]),
            bounds: [first == 0, first + count == down],
            samples: count * row_samples,
            ..Part::whole(stage, rows)
        }
    };
    (0..down).step_by(height as usize).map(part).collect()
}

/// A pass over a list of at most `longest` entries, divided into chunks.
pub fn chunks(stage: &'static Stage, longest: u32, rows: Rows) -> Vec<Part> {
    let count = longest.div_ceil(SAMPLES_PER_SUBMISSION).max(1);
    let part = |chunk: u32| {
        let first = chunk * SAMPLES_PER_SUBMISSION;
        Part {
            first,
            extent: Extent::Chunk(chunk),
            bounds: [chunk == 0, chunk + 1 == count],
            samples: SAMPLES_PER_SUBMISSION.min(longest - first) / per_sample(stage),
            ..Part::whole(stage, rows)
        }
    };
    (0..count).map(part).collect()
}

/// A pass along every row or every column in the direction of `step`, one thread each.
pub fn lines(stage: &'static Stage, columns: u32, rows: Rows, step: [i32; 2]) -> Vec<Part> {
    let [count, length] = if step[0] == 0 { [columns, rows.count()] } else { [rows.count(), columns] };
    let groups = (SAMPLES_PER_SUBMISSION / (length * TRACE_GROUP)).max(1);
    let at_once = groups * TRACE_GROUP;
    let part = |first: u32| Part {
        first,
        step,
        extent: Extent::Groups([groups, 1]),
        bounds: [first == 0, first + at_once >= count],
        samples: at_once * length,
        ..Part::whole(stage, rows)
    };
    (0..count).step_by(at_once as usize).map(part).collect()
}

//! A frame's work in parts, and the parts in submissions that no watchdog takes for a hung device.
//!
//! Drivers reset a device that works on one submission for too long: after 2 s on Windows (Microsoft, "Timeout detection
//! and recovery (TDR)"), after 0.5 s under Linux on Mali (`JOB_TIMEOUT_MS`, panfrost) and Adreno
//! (`DRM_MSM_HANGCHECK_DEFAULT_PERIOD`, msm). A slow phone traces 10 million rays a second, a sample takes about 4 (itself,
//! shadows, one or two bounces). [`SAMPLES_PER_SUBMISSION`] of them take 0.1 s there: a fifth of the strictest limit.

use crate::passes::{FrameSpec, Recipe, Stage, TRACE_GROUP, Tracing};

mod bands;
#[cfg(test)]
mod tests;

use bands::bands;
pub use bands::{Band, band_rows};

/// The most samples that one submission traces. More means fewer gaps between submissions and longer ones.
///
/// A frame of fewer samples (450x450 by either method) is one submission. A row of workgroups is not divided, which
/// matters from 32,768 pixels of width on.
pub const SAMPLES_PER_SUBMISSION: u32 = 1 << 18;

/// Pixels that an interpolating pass treats in the time of one traced sample (measured: 13 % of a frame's time for 3/4 of
/// its pixels, against 87 % for the 31 % that are traced).
const INTERPOLATED_PER_TRACED: u32 = 16;

/// The samples that a stage treats: every `stride`-th row from `row` until before `end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// Samples from one reference to the next, in both directions.
    pub stride: u32,
    /// The first row.
    pub row: u32,
    /// Behind the last row.
    pub end: u32,
    /// The row that the band's storage is folded at ([`Band::turn`]).
    pub turn: u32,
}

impl Rows {
    /// How many.
    pub fn count(&self) -> u32 {
        self.end.saturating_sub(self.row).div_ceil(self.stride)
    }
}

/// One dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its kernel.
    pub stage: &'static Stage,
    /// What it treats.
    pub rows: Rows,
    /// The position of its pass in the frame.
    pub pass: usize,
    /// Where its pass goes on: a row of workgroups, or a place in the list.
    pub first: u32,
    /// From one sample to the next of a scan, or of what a filter looks at.
    pub step: [i32; 2],
    /// The most samples that a thread of the postcorrection traces.
    pub walk: u32,
    /// How much of the pass it does.
    pub extent: Extent,
    /// Whether its pass begins and whether it ends with it.
    pub bounds: [bool; 2],
    /// The most samples that it traces, or as many as take its time.
    pub samples: u32,
}

impl Part {
    /// A pass of one dispatch of one workgroup that traces nothing.
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

    /// Which of the two filtered pictures it writes, by its level's step.
    pub fn filtered(&self) -> usize {
        // The first level reads what a part without a step has begun.
        usize::from(self.step[0] != 0 && self.step[0].trailing_zeros().is_multiple_of(2))
    }
}

/// How much a dispatch does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// So many workgroups.
    Groups([u32; 2]),
    /// So many workgroups as this chunk of the list needs.
    Chunk(u32),
    /// So many workgroups as renew the frame's share of so many tiles.
    Refreshed(u32),
}

/// All dispatches of a frame, in order.
pub struct Plan {
    /// Samples of the frame.
    pub grid: [u32; 2],
    /// One by one.
    pub parts: Vec<Part>,
    /// Rows of samples that are stored at once.
    pub stored_rows: u32,
    /// The most samples that one pass may list.
    longest_list: u32,
}

impl Plan {
    /// The plan of a frame of that grid of samples, in bands of that many rows ([`band_rows`]).
    pub fn new(spec: &FrameSpec, grid: [u32; 2], band: u32) -> Self {
        let mut plan = Self { grid, parts: Vec::new(), stored_rows: 0, longest_list: 0 };
        for band in bands(grid[1], band) {
            plan.stored_rows = plan.stored_rows.max(band.end - band.first);
            (Recipe::of(spec.settings.method).plan)(&mut plan, spec, &band);
        }
        plan
    }

    /// Makes room for a list of that many entries.
    pub fn lists(&mut self, longest: u32) {
        self.longest_list = self.longest_list.max(longest);
    }

    /// Compacts the list of samples of a grid and traces them.
    pub fn traces(&mut self, [compact, trace]: [&'static Stage; 2], columns: u32, rows: Rows) {
        let longest = columns * rows.count();
        self.lists(longest);
        self.push(once(compact, rows));
        self.push(chunks(trace, longest, rows));
    }

    /// Adds a pass.
    pub fn push(&mut self, parts: Vec<Part>) {
        let pass = self.parts.last().map_or(0, |part| part.pass + 1);
        self.parts.extend(parts.into_iter().map(|part| Part { pass, ..part }));
    }

    /// The stage of each pass, in order.
    pub fn passes(&self) -> Vec<&'static Stage> {
        self.parts.chunk_by(|a, b| a.pass == b.pass).map(|parts| parts[0].stage).collect()
    }

    /// Chunks of the longest list.
    pub fn chunks(&self) -> u32 {
        self.longest_list.div_ceil(SAMPLES_PER_SUBMISSION).max(1)
    }

    /// The parts by submission, with the position of each.
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

/// A pass of one workgroup.
pub fn once(stage: &'static Stage, rows: Rows) -> Vec<Part> {
    one(stage, rows, [1, 1])
}

/// A pass of one dispatch that traces nothing.
pub fn one(stage: &'static Stage, rows: Rows, groups: [u32; 2]) -> Vec<Part> {
    vec![Part { extent: Extent::Groups(groups), ..Part::whole(stage, rows) }]
}

/// How many samples a stage treats in the time of a traced one.
fn per_sample(stage: &Stage) -> u32 {
    if stage.tracing == Tracing::No { INTERPOLATED_PER_TRACED } else { 1 }
}

/// A pass over a grid of samples, in groups of rows of workgroups; a stage without rows is no part.
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

/// A pass over a list of at most that many samples.
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

/// A pass along every row or every column, one way.
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

//! A frame's work in parts, and the parts in submissions that no watchdog takes for a hung device.
//!
//! Drivers reset a device that works on one submission for too long: after 2 s on Windows (Microsoft, "Timeout detection
//! and recovery (TDR)"), after 0.5 s under Linux on Mali (`JOB_TIMEOUT_MS`, panfrost) and Adreno
//! (`DRM_MSM_HANGCHECK_DEFAULT_PERIOD`, msm). A slow phone traces 10 million rays a second, a sample takes about 4 (itself,
//! shadows, one or two bounces). [`SAMPLES_PER_SUBMISSION`] of them take 0.1 s there: a fifth of the strictest limit.

use crate::{
    Denoise, Filter, Method, Postcorrect,
    passes::{Stage, TRACE_GROUP},
};

mod bands;
mod history;
mod samples;
#[cfg(test)]
mod tests;

pub use bands::band_rows;
use bands::{Band, bands};
pub use samples::REFINE_ROUNDS;

/// The most samples that one submission traces. More means fewer gaps between submissions and longer ones.
///
/// A frame of fewer samples (450x450 by either method) is one submission. A row of workgroups is not divided, which
/// matters from 32,768 pixels of width on.
pub const SAMPLES_PER_SUBMISSION: u32 = 1 << 18;

/// Pixels that an interpolating pass treats in the time of one traced sample (measured: 13 % of a frame's time for 3/4 of
/// its pixels, against 87 % for the 31 % that are traced).
const INTERPOLATED_PER_TRACED: u32 = 16;

/// Rounds of the postcorrection. In the first ones a thread traces one sample: most of what is found is near, and threads
/// that walk on stay in step with each other no longer. In the others they walk, together twice as far as the longest
/// straight run of a band.
const SHORT_ROUNDS: u32 = 6;
const LONG_ROUNDS: u32 = 10;

/// The most samples that one round traces.
pub const ROUND_SAMPLES: u32 = SAMPLES_PER_SUBMISSION / 4;

/// Sides of the tiles that a workgroup of 64 and of 256 threads treats.
const TRACED_TILE: u32 = 8;
const INTERPOLATED_TILE: u32 = 16;
/// And of 64 threads that take one path after the other.
pub const PATH_TILE: u32 = 32;

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
    pub stage: Stage,
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
    Renewed(u32),
}

/// All dispatches of a frame, in order.
pub struct Plan {
    /// One by one.
    pub parts: Vec<Part>,
    /// Rows of samples that are stored at once.
    pub stored_rows: u32,
    /// The most samples that one pass may list.
    longest_list: u32,
}

/// What a frame is made of besides its method.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Samples of the frame.
    pub grid: [u32; 2],
    /// Samples along a side of a pixel.
    pub sampling: u32,
    /// Side of the base block.
    pub block: u32,
    /// Rows of samples of a band, see [`band_rows`].
    pub band: u32,
    /// What is traced again.
    pub postcorrect: Postcorrect,
    /// Extra samples are added.
    pub supersamples: bool,
    /// They go to whole pixels, step by step.
    pub refines: bool,
    /// How a pixel follows from several samples.
    pub filter: Filter,
    /// What is done about noise of paths.
    pub denoise: Denoise,
    /// Points of thin things.
    pub landmarks: u32,
    /// Samples of one eye count for the other.
    pub crosses: bool,
}

impl Plan {
    /// The plan of a frame.
    pub fn new(method: Method, shape: &Shape) -> Self {
        let mut plan = Self { parts: Vec::new(), stored_rows: 0, longest_list: 0 };
        for band in bands(shape.grid[1], shape.band) {
            plan.stored_rows = plan.stored_rows.max(band.end - band.first);
            match method {
                Method::Full if shape.filter == Filter::Tent && shape.sampling > 1 => {
                    plan.filtered(shape, &band);
                    continue;
                }
                Method::Full => plan.push(tiles(Stage::Full, shape.grid[0], band.rows(1, band.own))),
                Method::Checkerboard => {
                    let (width, rows) = (shape.grid[0], band.rows(1, band.own));
                    plan.push(tiles(Stage::Checkerboard, width.div_ceil(2), rows));
                    plan.push(tiles(Stage::Fill, width, rows));
                }
                Method::Frameless => plan.frameless(shape, band.rows(1, band.own)),
                Method::Path | Method::Vr => plan.paths(shape, band.rows(1, band.own)),
                Method::Reproject => plan.reproject(shape, band.rows(1, band.own)),
                Method::Adaptive => {
                    plan.adaptive(shape, &band);
                    plan.postcorrect(shape, &band);
                    if shape.supersamples {
                        plan.supersample(shape, band.rows(1, band.own));
                    }
                }
                Method::Quincunx => plan.quincunx(shape.grid[0], &band),
                Method::Supersample => {
                    let (rows, stored) = band.alone(shape.grid[1], 1);
                    plan.stored_rows = plan.stored_rows.max(stored.count());
                    plan.push(tiles(Stage::Presample, shape.grid[0], stored));
                    plan.supersample(shape, rows);
                }
            }
            if shape.sampling > 1 {
                plan.push(tiles(Stage::Resolve, shape.grid[0] / shape.sampling, band.pixels(shape.sampling)));
            }
        }
        plan
    }

    /// Kim 2016, Table 2, for base blocks of any size: each level halves the distance of the references.
    fn adaptive(&mut self, shape: &Shape, band: &Band) {
        let [width, _] = shape.grid;
        // A ray through one sample of each block.
        self.push(tiles(Stage::Base, width.div_ceil(shape.block), band.base(shape.block)));
        let levels = std::iter::successors(Some(shape.block), |stride| Some(stride / 2));
        for stride in levels.take_while(|stride| *stride >= 2) {
            // The samples between them in their rows: interpolate or list, then trace the listed.
            let (rows, columns) = (band.base(stride), width.div_ceil(stride));
            self.push(tiles(Stage::SimilarityA1, columns, rows));
            self.traces([Stage::CompactA1, Stage::TraceA1], columns, rows);
            // The rows between: the same, from the samples above and below.
            let (rows, columns) = (band.between(stride), width.div_ceil(stride / 2));
            self.push(tiles(Stage::SimilarityA2, columns, rows));
            self.traces([Stage::CompactA2, Stage::TraceA2], columns, rows);
        }
    }

    /// Kim 2016, section 4, inside the band.
    fn postcorrect(&mut self, shape: &Shape, band: &Band) {
        let rows = band.rows(1, [band.first, band.end]);
        let samples = shape.grid[0] * rows.count();
        match shape.postcorrect {
            Postcorrect::Auto | Postcorrect::Off => {}
            Postcorrect::Scans => {
                for step in [[1, 0], [-1, 0], [0, 1], [0, -1]] {
                    self.push(lines(Stage::PostcorrectScan, shape.grid[0], band.rows(1, band.own), step));
                }
            }
            Postcorrect::Objects | Postcorrect::On => {
                self.longest_list = self.longest_list.max(samples);
                self.push(once(Stage::CompactSeed, rows));
                self.push(chunks(Stage::PostcorrectSeed, samples, rows));
                if shape.landmarks > 0 {
                    let groups = [shape.landmarks.div_ceil(TRACE_GROUP), 1];
                    self.push(one(Stage::PostcorrectLandmarks, rows, groups));
                }
                let far = 2 * (shape.grid[0] + rows.count()) / LONG_ROUNDS + 1;
                for round in 0..SHORT_ROUNDS + LONG_ROUNDS {
                    let walk = if round < SHORT_ROUNDS { 1 } else { far };
                    self.push(once(Stage::CompactPostcorrect, rows));
                    let parts = chunks(Stage::Postcorrect, samples.min(ROUND_SAMPLES), rows);
                    self.push(parts.into_iter().map(|part| Part { walk, ..part }).collect());
                }
            }
        }
    }

    fn traces(&mut self, [compact, trace]: [Stage; 2], columns: u32, rows: Rows) {
        let longest = columns * rows.count();
        self.longest_list = self.longest_list.max(longest);
        self.push(once(compact, rows));
        self.push(chunks(trace, longest, rows));
    }

    fn push(&mut self, parts: Vec<Part>) {
        let pass = self.parts.last().map_or(0, |part| part.pass + 1);
        self.parts.extend(parts.into_iter().map(|part| Part { pass, ..part }));
    }

    /// The stage of each pass, in order.
    pub fn passes(&self) -> Vec<Stage> {
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

/// A stage of one workgroup.
fn once(stage: Stage, rows: Rows) -> Vec<Part> {
    one(stage, rows, [1, 1])
}

/// A stage of one dispatch that traces nothing.
fn one(stage: Stage, rows: Rows, groups: [u32; 2]) -> Vec<Part> {
    let extent = Extent::Groups(groups);
    vec![Part {
        stage,
        rows,
        pass: 0,
        first: 0,
        step: [0; 2],
        walk: 0,
        extent,
        bounds: [true, true],
        samples: 0,
    }]
}

/// A stage that treats a grid of samples, in groups of rows of workgroups; a stage without rows is no part.
fn tiles(stage: Stage, columns: u32, rows: Rows) -> Vec<Part> {
    let (side, per_sample) = match stage {
        Stage::Full
        | Stage::Base
        | Stage::Checkerboard
        | Stage::Presample
        | Stage::QuincunxBase
        | Stage::Look => (TRACED_TILE, 1),
        Stage::Path => (PATH_TILE, 1),
        Stage::SubpixelTest | Stage::RefineTest => (TRACED_TILE, INTERPOLATED_PER_TRACED),
        _ => (INTERPOLATED_TILE, INTERPOLATED_PER_TRACED),
    };
    let [across, down] = [columns, rows.count()].map(|n| n.div_ceil(side));
    let row_samples = across * side * side / per_sample;
    let height = (SAMPLES_PER_SUBMISSION / row_samples).max(1);
    let part = |first: u32| {
        let count = height.min(down - first);
        Part {
            stage,
            rows,
            pass: 0,
            first,
            step: [0; 2],
            walk: 0,
            extent: Extent::Groups([across, count]),
            bounds: [first == 0, first + count == down],
            samples: count * row_samples,
        }
    };
    (0..down).step_by(height as usize).map(part).collect()
}

/// A stage that works through a list of at most that many samples.
fn chunks(stage: Stage, longest: u32, rows: Rows) -> Vec<Part> {
    let traces = !matches!(stage, Stage::PostcorrectSeed | Stage::CellTest);
    let per_sample = if traces { 1 } else { INTERPOLATED_PER_TRACED };
    let count = longest.div_ceil(SAMPLES_PER_SUBMISSION).max(1);
    let part = |chunk: u32| {
        let first = chunk * SAMPLES_PER_SUBMISSION;
        Part {
            stage,
            rows,
            pass: 0,
            first,
            step: [0; 2],
            walk: 0,
            extent: Extent::Chunk(chunk),
            bounds: [chunk == 0, chunk + 1 == count],
            samples: SAMPLES_PER_SUBMISSION.min(longest - first) / per_sample,
        }
    };
    (0..count).map(part).collect()
}

/// A stage that goes along every row or every column, one way.
fn lines(stage: Stage, columns: u32, rows: Rows, step: [i32; 2]) -> Vec<Part> {
    let [count, length] = if step[0] == 0 { [columns, rows.count()] } else { [rows.count(), columns] };
    let groups = (SAMPLES_PER_SUBMISSION / (length * TRACE_GROUP)).max(1);
    let at_once = groups * TRACE_GROUP;
    let part = |first: u32| Part {
        stage,
        rows,
        pass: 0,
        first,
        step,
        walk: 0,
        extent: Extent::Groups([groups, 1]),
        bounds: [first == 0, first + at_once >= count],
        samples: at_once * length,
    };
    (0..count).step_by(at_once as usize).map(part).collect()
}

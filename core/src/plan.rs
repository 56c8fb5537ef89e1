//! A frame's work in parts, and the parts in submissions that no watchdog takes for a hung device.
//!
//! Drivers reset a device that works on one submission for too long: after 2 s on Windows (Microsoft, "Timeout detection
//! and recovery (TDR)"), after 0.5 s under Linux on Mali (`JOB_TIMEOUT_MS`, panfrost) and Adreno
//! (`DRM_MSM_HANGCHECK_DEFAULT_PERIOD`, msm). A slow phone traces 10 million rays a second, a sample takes about 4 (itself,
//! shadows, one or two bounces). [`SAMPLES_PER_SUBMISSION`] of them take 0.1 s there: a fifth of the strictest limit.

use crate::{Method, passes::Stage};

/// The most samples that one submission traces. More means fewer gaps between submissions and longer ones.
///
/// A frame of fewer samples (450x450 by either method) is one submission. A row of workgroups is not divided, which
/// matters from 32,768 pixels of width on.
pub const SAMPLES_PER_SUBMISSION: u32 = 1 << 18;

/// Pixels that an interpolating pass treats in the time of one traced sample (measured: 13 % of a frame's time for 3/4 of
/// its pixels, against 87 % for the 31 % that are traced).
const INTERPOLATED_PER_TRACED: u32 = 16;

/// Sides of the tiles that a workgroup of 64 and of 256 threads treats.
const TRACED_TILE: u32 = 8;
const INTERPOLATED_TILE: u32 = 16;

/// One dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its kernel.
    pub stage: Stage,
    /// The position of its stage in the frame.
    pub pass: usize,
    /// Where its stage goes on: a row of workgroups, or a place in the list.
    pub first: u32,
    /// How much of the stage it does.
    pub extent: Extent,
    /// Whether its stage begins and whether it ends with it.
    pub bounds: [bool; 2],
    /// The most samples that it traces, or as many as take its time.
    pub samples: u32,
}

/// How much a dispatch does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// So many workgroups.
    Groups([u32; 2]),
    /// So many workgroups as this chunk of the list needs.
    Chunk(u32),
}

/// All dispatches of a frame, in order.
pub struct Plan {
    /// One by one.
    pub parts: Vec<Part>,
    /// Entries of the longest list.
    pub longest_list: u32,
}

impl Plan {
    /// The plan of a frame of that size.
    pub fn new(method: Method, [width, height]: [u32; 2]) -> Self {
        if method == Method::Full {
            return Self::of(vec![tiles(Stage::Full, [width, height])], 0);
        }
        let (columns, rows) = (width.div_ceil(2), height.div_ceil(2));
        let (a1, a2) = (width / 2 * rows, width * (height / 2));
        let stages = vec![
            // A ray through every second pixel of every second row.
            tiles(Stage::Base, [columns, rows]),
            // The pixels between them in their rows: interpolate or list, then trace the listed.
            tiles(Stage::SimilarityA1, [columns, rows]),
            once(Stage::CompactA1),
            chunks(Stage::TraceA1, a1),
            // The rows between: the same, from the pixels above and below.
            tiles(Stage::SimilarityA2, [width, rows]),
            once(Stage::CompactA2),
            chunks(Stage::TraceA2, a2),
        ];
        Self::of(stages, a1.max(a2))
    }

    fn of(stages: Vec<Vec<Part>>, longest_list: u32) -> Self {
        let numbered =
            |(pass, parts): (usize, Vec<Part>)| parts.into_iter().map(move |part| Part { pass, ..part });
        Self { parts: stages.into_iter().enumerate().flat_map(numbered).collect(), longest_list }
    }

    /// The stages, in order.
    pub fn stages(&self) -> Vec<Stage> {
        let mut stages: Vec<_> = self.parts.iter().map(|part| part.stage).collect();
        stages.dedup();
        stages
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
fn once(stage: Stage) -> Vec<Part> {
    vec![Part { stage, pass: 0, first: 0, extent: Extent::Groups([1, 1]), bounds: [true, true], samples: 0 }]
}

/// A stage that treats a grid of pixels, in bands of rows of workgroups.
fn tiles(stage: Stage, [columns, rows]: [u32; 2]) -> Vec<Part> {
    let traces = matches!(stage, Stage::Full | Stage::Base);
    let (side, per_sample) =
        if traces { (TRACED_TILE, 1) } else { (INTERPOLATED_TILE, INTERPOLATED_PER_TRACED) };
    let [across, down] = [columns, rows].map(|n| n.div_ceil(side));
    let row_samples = across * side * side / per_sample;
    let band = (SAMPLES_PER_SUBMISSION / row_samples).max(1);
    let part = |first: u32| {
        let count = band.min(down - first);
        Part {
            stage,
            pass: 0,
            first,
            extent: Extent::Groups([across, count]),
            bounds: [first == 0, first + count == down],
            samples: count * row_samples,
        }
    };
    (0..down).step_by(band as usize).map(part).collect()
}

/// A stage that works through a list of at most that many samples.
fn chunks(stage: Stage, longest: u32) -> Vec<Part> {
    let count = longest.div_ceil(SAMPLES_PER_SUBMISSION).max(1);
    let part = |chunk: u32| {
        let first = chunk * SAMPLES_PER_SUBMISSION;
        Part {
            stage,
            pass: 0,
            first,
            extent: Extent::Chunk(chunk),
            bounds: [chunk == 0, chunk + 1 == count],
            samples: SAMPLES_PER_SUBMISSION.min(longest - first),
        }
    };
    (0..count).map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZES: [[u32; 2]; 10] = [
        [1, 1],
        [1, 7],
        [450, 450],
        [512, 513],
        [1025, 4097],
        [2560, 1440],
        [16_384, 1],
        [1, 16_384],
        [16_384, 16_384],
        [32_768, 8],
    ];

    #[test]
    fn no_submission_exceeds_the_bound_and_no_part_is_lost() {
        for (size, method) in SIZES.iter().flat_map(|s| [(s, Method::Full), (s, Method::Adaptive)]) {
            let plan = Plan::new(method, *size);
            let submissions = plan.submissions();
            let parts: Vec<_> = submissions.iter().flatten().copied().collect();
            assert!(parts.iter().map(|(index, _)| *index).eq(0..plan.parts.len()), "{size:?}: order");
            for parts in &submissions {
                let samples: u32 = parts.iter().map(|(_, part)| part.samples).sum();
                assert!(samples <= SAMPLES_PER_SUBMISSION, "{size:?}, {method:?}: {samples} in {parts:?}");
            }
        }
    }

    #[test]
    fn every_stage_is_covered_once() {
        for (size, method) in SIZES.iter().flat_map(|s| [(s, Method::Full), (s, Method::Adaptive)]) {
            let parts = Plan::new(method, *size).parts;
            for of_stage in parts.chunk_by(|a, b| a.stage == b.stage) {
                let stage = of_stage[0].stage;
                let mut next = 0;
                for (i, part) in of_stage.iter().enumerate() {
                    assert_eq!(part.first, next, "{size:?} {stage:?}");
                    assert_eq!(part.bounds, [i == 0, i + 1 == of_stage.len()], "{size:?} {stage:?}");
                    next += match part.extent {
                        Extent::Groups([_, rows]) => rows,
                        Extent::Chunk(chunk) => {
                            assert_eq!(chunk as usize, i, "{size:?} {stage:?}");
                            part.samples
                        }
                    };
                }
                let [columns, rows] = [size[0].div_ceil(2), size[1].div_ceil(2)];
                let expected = match stage {
                    Stage::Full => size[1].div_ceil(8),
                    Stage::Base => rows.div_ceil(8),
                    Stage::SimilarityA1 | Stage::SimilarityA2 => rows.div_ceil(16),
                    Stage::CompactA1 | Stage::CompactA2 => 1,
                    Stage::TraceA1 => (size[0] - columns) * rows,
                    Stage::TraceA2 => size[0] * (size[1] - rows),
                };
                assert_eq!(next, expected, "{size:?} {stage:?}");
            }
        }
    }

    #[test]
    fn small_frames_are_one_submission_of_one_dispatch_a_stage() {
        for (method, stages) in [(Method::Full, 1), (Method::Adaptive, 7)] {
            let submissions = Plan::new(method, [450, 450]).submissions();
            assert_eq!(submissions.iter().map(Vec::len).collect::<Vec<_>>(), [stages], "{method:?}");
        }
    }
}

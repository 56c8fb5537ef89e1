use super::*;
use crate::{
    Denoise, Method, Paths, Postcorrect, Refine, Scene, Settings,
    device::gpu_scene::SceneFacts,
    passes::{PATH_TILE, TRACED_TILE, Work, adaptive, frameless, full, path, postcorrect},
    scene::Thinness,
};

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

/// A frame size and the settings that its plan depends on.
#[derive(Clone, Copy, Debug)]
struct Shape {
    grid: [u32; 2],
    band: u32,
    probe_points: u32,
    settings: Settings,
}

impl Shape {
    fn plan(&self, method: Method) -> Plan {
        let settings = Settings { method, ..self.settings };
        let spec = FrameSpec::of_scene(&Scene::default(), &Thinness::default(), &settings);
        let facts = SceneFacts { probe_points: self.probe_points, ..spec.scene };
        Plan::new(&FrameSpec { scene: facts, ..spec }, self.grid, self.band)
    }

    fn with(self, settings: Settings) -> Self {
        Self { settings, ..self }
    }
}

/// Frames of many sizes and block sizes, in one band and in the smallest bands.
fn shapes() -> impl Iterator<Item = Shape> {
    let of_size = |grid| {
        [(2, 1, u32::MAX), (2, 1, 16), (4, 1, 48), (8, 1, 16), (8, 2, 1024), (2, 4, 64), (4, 3, 48)].map(
            |(block, sampling, band)| Shape {
                grid: grid_of(grid, sampling),
                band,
                probe_points: 2000,
                settings: Settings {
                    sampling,
                    block,
                    postcorrect: match block {
                        2 => Postcorrect::On,
                        4 => Postcorrect::Off,
                        _ => Postcorrect::Scans,
                    },
                    ..Settings::default()
                },
            },
        )
    };
    SIZES.into_iter().flat_map(of_size)
}

fn grid_of(size: [u32; 2], sampling: u32) -> [u32; 2] {
    size.map(|side| side * sampling)
}

fn plans() -> impl Iterator<Item = (Shape, Plan)> {
    let whole = |s: &Shape| Shape { band: u32::MAX, ..*s }.with(Settings { sampling: 1, ..s.settings });
    shapes().flat_map(move |s| {
        // Those with bands and passes of their own stand below.
        let apart = [Method::Supersample, Method::Quincunx, Method::Path, Method::Vr];
        let of_one_sample = Method::ALL
            .into_iter()
            .filter(move |method| method.takes_one_sample() && !apart.contains(method))
            .map(move |method| (whole(&s), whole(&s).plan(method)));
        let supersampled = [false, true].map(|refines| {
            let refine = if refines { Refine::On } else { Refine::Off };
            let shape = Shape { band: s.band.min(1024), ..s };
            let shape = shape.with(Settings { sampling: 1, refine, ..s.settings });
            (shape, shape.plan(Method::Supersample))
        });
        let paths = Denoise::ALL.map(|denoise| {
            let shape = denoised(whole(&s), denoise);
            (shape, shape.plan(Method::Vr))
        });
        [(s, s.plan(Method::Full)), (s, s.plan(Method::Adaptive))]
            .into_iter()
            .chain(paths)
            .chain(of_one_sample)
            .chain(supersampled)
    })
}

fn denoised(shape: Shape, denoise: Denoise) -> Shape {
    let paths = Paths { denoise, ..shape.settings.paths };
    shape.with(Settings { paths, ..shape.settings })
}

#[test]
fn no_submission_exceeds_the_bound_and_no_part_is_lost() {
    for (shape, plan) in plans() {
        let submissions = plan.submissions();
        let parts: Vec<_> = submissions.iter().flatten().copied().collect();
        assert!(parts.iter().map(|(index, _)| *index).eq(0..plan.parts.len()), "{shape:?}: order");
        for parts in &submissions {
            let samples: u32 = parts.iter().map(|(_, part)| part.samples).sum();
            // A row of workgroups is not divided, and neither is a workgroup of scans.
            let [width, height] = shape.grid;
            let scans =
                if shape.settings.postcorrect == Postcorrect::Scans { 64 * width.max(height) } else { 0 };
            let paths = parts.iter().any(|(_, part)| *part.stage == path::PATH);
            let tile = if paths { PATH_TILE } else { TRACED_TILE };
            let bound = SAMPLES_PER_SUBMISSION.max(tile * width.next_multiple_of(tile)).max(scans);
            assert!(samples <= bound, "{shape:?}: {samples} in {parts:?}");
        }
    }
}

#[test]
fn every_pass_is_covered_once() {
    for (shape, plan) in plans() {
        for (pass, parts) in plan.parts.chunk_by(|a, b| a.pass == b.pass).enumerate() {
            let mut next = 0;
            for (i, part) in parts.iter().enumerate() {
                assert_eq!((part.pass, part.stage), (pass, parts[0].stage), "{shape:?}");
                assert_eq!(part.first, next, "{shape:?} {part:?}");
                assert_eq!(part.bounds, [i == 0, i + 1 == parts.len()], "{shape:?} {part:?}");
                next += match part.extent {
                    Extent::Groups([groups, 1]) if *part.stage == postcorrect::POSTCORRECT_SCAN => {
                        64 * groups
                    }
                    Extent::Groups([_, rows]) => rows,
                    Extent::Refreshed(tiles) => tiles,
                    Extent::Chunk(chunk) => {
                        assert_eq!(chunk as usize, i, "{shape:?} {part:?}");
                        SAMPLES_PER_SUBMISSION
                    }
                };
            }
        }
        assert_eq!(plan.passes().len(), plan.parts.last().map_or(0, |part| part.pass + 1), "{shape:?}");
    }
}

#[test]
fn dispatches_have_the_shape_that_their_stage_says() {
    for (shape, plan) in plans() {
        for part in &plan.parts {
            let fits = match part.stage.work {
                Work::Tiles(_) | Work::Fixed => matches!(part.extent, Extent::Groups(_)),
                Work::Lines => matches!(part.extent, Extent::Groups([_, 1])) && part.step != [0, 0],
                Work::List => matches!(part.extent, Extent::Chunk(_)),
                Work::Ranks => matches!(part.extent, Extent::Refreshed(_)),
            };
            assert!(fits, "{shape:?} {part:?}");
        }
    }
}

/// The rows that a stage processes, in order of execution; for the adaptive steps only at one distance of
/// references.
fn rows_of(plan: &Plan, stage: &Stage, stride: u32) -> Vec<u32> {
    let parts = plan.parts.iter().filter(|part| *part.stage == *stage && part.bounds[0]);
    let rows = parts.map(|part| part.rows).filter(|rows| rows.stride == stride);
    rows.flat_map(|rows| (rows.row..rows.end).step_by(rows.stride as usize)).collect()
}

#[test]
fn every_row_is_made_once_and_stored_once_at_a_time() {
    for shape in shapes() {
        let [_, height] = shape.grid;
        let every = |from: u32, stride: u32| (from..height).step_by(stride as usize).collect::<Vec<_>>();
        let full = shape.plan(Method::Full);
        assert_eq!(rows_of(&full, &full::FULL, 1), every(0, 1), "{shape:?}");
        let adaptive = shape.plan(Method::Adaptive);
        assert_eq!(
            rows_of(&adaptive, &adaptive::BASE, shape.settings.block),
            every(0, shape.settings.block),
            "{shape:?}"
        );
        for stride in [8, 4, 2].into_iter().filter(|stride| *stride <= shape.settings.block) {
            assert_eq!(rows_of(&adaptive, &adaptive::SIMILARITY_A1, stride), every(0, stride), "{shape:?}");
            assert_eq!(
                rows_of(&adaptive, &adaptive::SIMILARITY_A2, stride),
                every(stride / 2, stride),
                "{shape:?}"
            );
        }
        for plan in [full, adaptive] {
            let pixels: Vec<_> = (0..height / shape.settings.sampling).collect();
            let resolved = if shape.settings.sampling > 1 { pixels } else { vec![] };
            assert_eq!(rows_of(&plan, &full::RESOLVE, 1), resolved, "{shape:?}");
            for part in plan.parts.iter().filter(|part| *part.stage != full::RESOLVE) {
                let (Rows { row, end, turn, .. }, rows) = (part.rows, plan.stored_rows);
                let folded = |y: u32| y.abs_diff(turn);
                assert!(row >= end || folded(row).max(folded(end - 1)) < rows, "{shape:?} {part:?}");
            }
        }
    }
}

/// Each level reads the buffer that the level before wrote; the first one reads what the preparing pass wrote.
#[test]
fn levels_of_a_filter_take_turns() {
    for shape in shapes() {
        let shape = denoised(Shape { band: u32::MAX, ..shape }, Denoise::Atrous);
        let plan = shape.with(Settings { sampling: 1, ..shape.settings }).plan(Method::Path);
        let passes: Vec<_> = plan.parts.iter().filter(|part| part.bounds[0]).collect();
        let steps: Vec<_> = passes.iter().map(|part| part.step[0]).collect();
        assert_eq!(steps, [0, 0, 1, 2, 4, 8], "{shape:?}");
        for pair in passes[1..].windows(2) {
            assert_ne!(pair[0].filtered(), pair[1].filtered(), "{shape:?}");
        }
    }
}

/// The number of threads in a tile follows its share, so dispatches begin and end with whole tiles.
#[test]
fn every_tile_is_renewed_once() {
    for (shape, plan) in plans() {
        let tiles = shape.grid.map(|side| u64::from(side.div_ceil(16))).iter().product::<u64>();
        let mut refreshed = 0;
        for part in plan.parts.iter().filter(|part| *part.stage == frameless::FRAMELESS) {
            let Extent::Refreshed(count) = part.extent else { panic!("{part:?}") };
            let last = part.bounds[1];
            assert!(last || (1..=256).all(|share| count * share % TRACE_GROUP == 0), "{shape:?} {part:?}");
            refreshed += u64::from(count);
        }
        assert!(refreshed == 0 || refreshed == tiles, "{shape:?}: {refreshed}");
    }
}

/// The row that two bands share has the same storage location in both.
#[test]
fn bands_fold_where_they_meet() {
    for (height, rows) in [(1, 16), (16, 16), (17, 16), (18, 16), (100, 16), (1440, 512), (5760, 512)] {
        let all: Vec<_> = bands(height, rows).collect();
        for pair in all.windows(2) {
            let shared = pair[1].first;
            assert_eq!(pair[0].end, shared + 1);
            assert_eq!(shared.abs_diff(pair[0].turn), shared.abs_diff(pair[1].turn), "{height} {rows}");
            assert!(pair[1].end > shared + 1, "{height} {rows}: a band of nothing");
        }
        assert_eq!(all.last().map(|band| band.end), Some(height));
    }
}

#[test]
fn bands_hold_whole_blocks_and_whole_pixels() {
    for sampling in 1..=16 {
        for most in [0, 1, 17, 100, 545, 4096] {
            let rows = band_rows(sampling, most);
            assert!(
                rows.is_multiple_of(16) && rows.is_multiple_of(sampling) && rows > 0,
                "{sampling} {most}: {rows}"
            );
            let least = rows == band_rows(sampling, 0);
            assert!(least || u64::from(rows) < most, "{sampling} {most}: {rows}");
        }
    }
}

#[test]
fn small_frames_are_one_submission_of_one_dispatch_a_stage() {
    for (method, stages) in [
        (Method::Full, 1),
        (Method::Adaptive, 7),
        (Method::Checkerboard, 2),
        (Method::Frameless, 1),
        (Method::Reproject, 5),
    ] {
        let settings = Settings { postcorrect: Postcorrect::Off, ..Settings::default() };
        let shape = Shape { grid: [450, 450], band: 1024, probe_points: 0, settings };
        let submissions = shape.plan(method).submissions();
        assert_eq!(submissions.iter().map(Vec::len).collect::<Vec<_>>(), [stages], "{method:?}");
    }
}

//! Frameless rendering: each frame traces a fraction of the pixels and keeps the others as they were.

use super::{FrameSpec, Recipe, recipe::Storage, stage::*, wgsl};
use crate::{
    frame::plan::{Band, Extent, Part, Plan, SAMPLES_PER_SUBMISSION},
    frame::sequence::{RANK_TILE, RANKS},
};

stages! {
    /// Traces the pixels whose rank is due in this frame.
    FRAMELESS = {
        name: "frameless", wgsl: "passes/frameless/frameless.wgsl", paper: "lecture, \"Low level optimizations\"",
        work: Work::Ranks, tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| {
            spec.tracing_sources([wgsl!("wgsl/reproject/refresh.wgsl"), spec.tile_order(), entry])
        },
    }
}

/// Frameless rendering as in the lecture, over the whole frame as one band.
pub const RECIPE: Recipe = Recipe { plan, traced: &FRAMELESS, storage: Storage::WHOLE, interpolated: &[] };

/// Tiles per dispatch, which bounds the work of frames that trace every rank. For any fraction of the ranks, the
/// tiles of a dispatch fill whole workgroups.
const TILES: u32 = SAMPLES_PER_SUBMISSION / RANKS;

fn plan(plan: &mut Plan, _: &FrameSpec, band: &Band) {
    let count = plan.grid.map(|side| side.div_ceil(RANK_TILE)).iter().product::<u32>();
    let part = |first: u32| {
        let tiles = TILES.min(count - first);
        Part {
            first,
            extent: Extent::Refreshed(tiles),
            bounds: [first == 0, first + tiles == count],
            samples: tiles * RANKS,
            ..Part::whole(&FRAMELESS, band.rows(1, band.own))
        }
    };
    plan.push((0..count).step_by(TILES as usize).map(part).collect());
}

//! A baseline: traces every second pixel and interpolates the others without a similarity check.

use super::{Output, Recipe, FrameSpec, recipe::{Loops, Storage}, stage::*};
use crate::frame::plan::{Band, Plan, tiles};

stages! {
    /// Traces every second pixel of each row, in a checkerboard pattern.
    CHECKERBOARD = {
        name: "checkerboard", wgsl: "passes/checkerboard/checkerboard.wgsl", paper: "a baseline",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| {
            let samples = FrameSpec { output: Output::Samples, ..*spec };
            samples.tracing_sources([spec.tile_order(), entry])
        },
    }
    /// Fills each other pixel with the average of its traced neighbours.
    FILL = {
        name: "fill", wgsl: "passes/checkerboard/fill.wgsl", paper: "a baseline",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.resolve_sources(entry),
    }
}

/// Checkerboard rendering: stores the radiance of each pixel.
pub const RECIPE: Recipe =
    Recipe { plan, traced: &CHECKERBOARD, storage: Storage { radiances: 1, ..Storage::WHOLE }, interpolated: &[(&FILL, Loops::Repeated(4.0))] };

fn plan(plan: &mut Plan, _: &FrameSpec, band: &Band) {
    let (width, rows) = (plan.grid[0], band.rows(1, band.own));
    plan.push(tiles(&CHECKERBOARD, width.div_ceil(2), rows));
    plan.push(tiles(&FILL, width, rows));
}

//! The baseline that traces every second pixel and interpolates the others, whatever they show.

use super::{Output, Recipe, Variant, recipe::Loops, stage::*};
use crate::plan::{Band, Plan, Shape, tiles};

stages! {
    /// Traces every second pixel.
    CHECKERBOARD = {
        name: "checkerboard", wgsl: "passes/checkerboard.wgsl", paper: "a baseline",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |variant, entry| {
            let samples = Variant { output: Output::Samples, ..*variant };
            samples.tracing_sources([variant.order(), entry])
        },
    }
    /// Averages the four traced neighbours of each other pixel.
    FILL = {
        name: "fill", wgsl: "passes/fill.wgsl", paper: "a baseline",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |variant, entry| variant.resolve_sources(entry),
    }
}

/// A ray through every second pixel.
pub const RECIPE: Recipe =
    Recipe { plan, traced: &CHECKERBOARD, interpolated: &[(&FILL, Loops::Repeated(4.0))] };

fn plan(plan: &mut Plan, shape: &Shape, band: &Band) {
    let (width, rows) = (shape.grid[0], band.rows(1, band.own));
    plan.push(tiles(&CHECKERBOARD, width.div_ceil(2), rows));
    plan.push(tiles(&FILL, width, rows));
}

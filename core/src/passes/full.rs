//! Full ray tracing: a sample in every cell of an even grid, and pixels from several samples.

use super::{Recipe, stage::*};
use crate::{
    Filter,
    plan::{Band, Plan, Rows, Shape, tiles},
};

stages! {
    /// Traces every sample.
    FULL = {
        name: "full", wgsl: "passes/full.wgsl", paper: "lecture, \"trace() in detail\"",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |variant, entry| variant.tracing_sources([variant.order(), entry]),
    }
    /// Filters the samples of each pixel.
    RESOLVE = {
        name: "resolve", wgsl: "passes/resolve.wgsl", paper: "Kim 2016, 6.1 (\"Sampling\")",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |variant, entry| variant.resolve_sources(entry),
    }
}

/// A ray through every sample.
pub const RECIPE: Recipe = Recipe { plan, traced: &FULL, interpolated: &[] };

fn plan(plan: &mut Plan, shape: &Shape, band: &Band) {
    if shape.filter == Filter::Tent && shape.sampling > 1 {
        return filtered(plan, shape, band);
    }
    plan.push(tiles(&FULL, shape.grid[0], band.rows(1, band.own)));
    resolve(plan, shape, band);
}

/// Pixels whose filter covers samples of their neighbours.
fn filtered(plan: &mut Plan, shape: &Shape, band: &Band) {
    let ([width, height], sampling) = (shape.grid, shape.sampling);
    let (rows, stored) = band.alone(height, sampling);
    plan.stored_rows = plan.stored_rows.max(stored.count());
    plan.push(tiles(&FULL, width, stored));
    let pixels = Rows { row: rows.row / sampling, end: rows.end / sampling, ..rows };
    plan.push(tiles(&RESOLVE, width / sampling, pixels));
}

/// Pixels from their own samples, where they have several.
pub fn resolve(plan: &mut Plan, shape: &Shape, band: &Band) {
    if shape.sampling > 1 {
        plan.push(tiles(&RESOLVE, shape.grid[0] / shape.sampling, band.pixels(shape.sampling)));
    }
}

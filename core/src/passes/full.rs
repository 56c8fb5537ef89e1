//! Full ray tracing: a sample in every cell of a regular grid, filtered to pixels if these have several.

use super::{FrameSpec, Recipe, recipe::Storage, stage::*};
use crate::{
    Filter,
    frame::plan::{Band, Plan, Rows, tiles},
};

stages! {
    /// Traces every sample of the grid.
    FULL = {
        name: "full", wgsl: "passes/full/full.wgsl", paper: "lecture, \"trace() in detail\"",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.tracing_sources([spec.tile_order(), entry]),
    }
    /// Filters the samples around each pixel to its colour.
    RESOLVE = {
        name: "resolve", wgsl: "passes/full/resolve.wgsl", paper: "Kim 2016, 6.1 (\"Sampling\")",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.resolve_sources(entry),
    }
}

/// Full ray tracing; stores samples only where pixels have several.
pub const RECIPE: Recipe = Recipe { plan, traced: &FULL, storage: Storage::NONE, interpolated: &[] };

fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    if spec.settings.filter == Filter::Tent && spec.settings.sampling > 1 {
        return filtered(plan, spec, band);
    }
    plan.push(tiles(&FULL, plan.grid[0], band.rows(1, band.own)));
    resolve(plan, spec, band);
}

/// Adds passes for a filter that reaches beyond the pixel, into the samples of its neighbours.
fn filtered(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let ([width, height], sampling) = (plan.grid, spec.settings.sampling);
    let (rows, stored) = band.alone(height, sampling);
    plan.stored_rows = plan.stored_rows.max(stored.count());
    plan.push(tiles(&FULL, width, stored));
    let pixels = Rows { row: rows.row / sampling, end: rows.end / sampling, ..rows };
    plan.push(tiles(&RESOLVE, width / sampling, pixels));
}

/// Adds the pass that filters each pixel's own samples, if it has several.
pub fn resolve(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    if spec.settings.sampling > 1 {
        plan.push(tiles(&RESOLVE, plan.grid[0] / spec.settings.sampling, band.pixels(spec.settings.sampling)));
    }
}

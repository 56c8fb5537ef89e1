//! Adaptive undersampling (Kim 2016): traces base samples, then interpolates between similar ones and traces the
//! others.

use super::{FrameSpec, Recipe, full, postcorrect, recipe::{Loops, Storage}, stage::*, supersample};
use crate::frame::plan::{Band, Plan, tiles};

stages! {
    /// Traces one sample of each base block.
    BASE = {
        name: "base", wgsl: "passes/adaptive/base.wgsl", paper: "Kim 2016, 3.2; Table 2, Step-I",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [Clears::ListHeader],
        sources: |spec, entry| spec.tracing_sources([spec.tile_order(), entry]),
    }
    /// Interpolates samples between two similar references of their row and lists the others.
    SIMILARITY_A1 = {
        name: "similarity_a1", wgsl: "passes/adaptive/similarity_a1.wgsl", paper: "Kim 2016, 3.3, 3.4, Table 1; Step-II-a",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.similarity_sources(entry),
    }
    /// Compacts the list of step A1 for indirect dispatch.
    COMPACT_A1 = {
        name: "compact_a1", wgsl: "passes/compact.wgsl", paper: "Kim 2016, 5; Step-II-b",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_step.wgsl"), entry),
    }
    /// Traces the listed samples of step A1.
    TRACE_A1 = {
        name: "trace_a1", wgsl: "passes/adaptive/trace.wgsl", paper: "Kim 2016, Step-II-c",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.tracing_sources([wgsl!("wgsl/adaptive/list.wgsl"), entry]),
    }
    /// Interpolates samples between two similar references of their column and lists the others.
    SIMILARITY_A2 = {
        name: "similarity_a2", wgsl: "passes/adaptive/similarity_a2.wgsl", paper: "Kim 2016, Step-III-a",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.similarity_sources(entry),
    }
    /// Compacts the list of step A2 for indirect dispatch.
    COMPACT_A2 = {
        name: "compact_a2", wgsl: "passes/compact.wgsl", paper: "Kim 2016, Step-III-b",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_step.wgsl"), entry),
    }
    /// Traces the listed samples of step A2.
    TRACE_A2 = {
        name: "trace_a2", wgsl: "passes/adaptive/trace.wgsl", paper: "Kim 2016, Step-III-c",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.tracing_sources([wgsl!("wgsl/adaptive/list.wgsl"), entry]),
    }
}

/// Adaptive undersampling (Kim 2016), with extra samples (Jin 2009) if the settings ask for them.
pub const RECIPE: Recipe =
    Recipe { plan, traced: &TRACE_A1, storage: Storage { listed: 1, ..Storage::NONE }, interpolated: &[(&SIMILARITY_A1, Loops::OverLights)] };

fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    steps(plan, spec, band);
    postcorrect::plan(plan, spec, band);
    if spec.settings.supersamples() {
        supersample::extra(plan, spec, band.rows(1, band.own));
    }
    full::resolve(plan, spec, band);
}

/// Kim 2016, Table 2, for base blocks of any size: each level halves the distance of the references.
fn steps(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let [width, _] = plan.grid;
    // Step-I: one traced sample per block.
    plan.push(tiles(&BASE, width.div_ceil(spec.settings.block), band.base(spec.settings.block)));
    let levels = std::iter::successors(Some(spec.settings.block), |stride| Some(stride / 2));
    for stride in levels.take_while(|stride| *stride >= 2) {
        // Step-II: the samples between references of a row are interpolated or listed, then the listed ones are
        // traced.
        let (rows, columns) = (band.base(stride), width.div_ceil(stride));
        plan.push(tiles(&SIMILARITY_A1, columns, rows));
        plan.traces([&COMPACT_A1, &TRACE_A1], columns, rows);
        // Step-III: the same in the rows between, from the samples above and below.
        let (rows, columns) = (band.between(stride), width.div_ceil(stride / 2));
        plan.push(tiles(&SIMILARITY_A2, columns, rows));
        plan.traces([&COMPACT_A2, &TRACE_A2], columns, rows);
    }
}

//! Refinement of whole pixels: follows thin lines from the pixels whose centre hits them, then adds samples in
//! strata that differ.

use super::{REFINE_MOST, REFINE_STEP, FrameSpec, stage::*, wgsl};
use crate::{
    device::shader::Source,
    frame::plan::{Plan, Rows, chunks, once, tiles},
};

stages! {
    /// Lists the pixels that differ from their neighbours.
    REFINE_TEST = {
        name: "refine_test", wgsl: "passes/refine/refine_test.wgsl", paper: "ours, after Jin 2009, 4.3.2",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::No, clears: [Clears::ListHeader],
        sources: |spec, entry| spec.test_sources([wgsl!("wgsl/supersample/refine_list.wgsl")], entry),
    }
    /// Compacts the pixels of the next round for indirect dispatch.
    COMPACT_REFINE = {
        name: "compact_refine", wgsl: "passes/compact.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/supersample/list_range_pending.wgsl"), entry),
    }
    /// Traces the first four samples of each listed pixel and lists neighbours with features that these reveal.
    REFINE = {
        name: "refine", wgsl: "passes/refine/refine.wgsl", paper: "ours, after Jin 2009, 4.3.3, and Kim 2016, 4",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.refine_sources(entry),
    }
    /// Compacts all refined pixels for indirect dispatch.
    COMPACT_STRATUM_TEST = {
        name: "compact_stratum_test", wgsl: "passes/compact.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_all.wgsl"), entry),
    }
    /// Selects the strata of refined pixels that get a sample and lists the pixels that have any.
    STRATUM_TEST = {
        name: "stratum_test", wgsl: "passes/refine/stratum_test.wgsl", paper: "ours, after Jin 2009, 4.2.2",
        work: Work::List, tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/adaptive/attributes_atomic.wgsl"));
            sources.extend(refined_sources());
            sources.extend([wgsl!("wgsl/supersample/pixel_edges.wgsl"), entry]);
            sources
        },
    }
    /// Compacts the pixels of the next step for indirect dispatch.
    COMPACT_STRATA = {
        name: "compact_strata", wgsl: "passes/compact.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/supersample/list_range_pending.wgsl"), entry),
    }
    /// Traces four more samples in the selected strata of each listed pixel.
    STRATA = {
        name: "strata", wgsl: "passes/refine/strata.wgsl", paper: "ours",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.refine_sources(entry),
    }
}

/// Number of rounds, which limits how many pixels a line is followed over from where a centre hits it.
pub const REFINE_ROUNDS: u32 = 16;

/// Rounds after the first list at most the frame's pixels divided by this.
const REFINE_LATER: u32 = 8;

/// Adds the rounds of refined pixels, then the steps of samples in their differing strata.
pub fn plan(plan: &mut Plan, rows: Rows) {
    let pixels = plan.grid[0] * rows.count();
    let longest = REFINE_MOST / REFINE_STEP * pixels;
    plan.lists(longest);
    plan.push(tiles(&REFINE_TEST, plan.grid[0], rows));
    for round in 0..REFINE_ROUNDS {
        let most = if round == 0 { longest } else { longest.div_ceil(REFINE_LATER) };
        plan.push(once(&COMPACT_REFINE, rows));
        plan.push(chunks(&REFINE, most, rows));
    }
    plan.push(once(&COMPACT_STRATUM_TEST, rows));
    plan.push(chunks(&STRATUM_TEST, pixels, rows));
    for _ in 1..REFINE_MOST / REFINE_STEP {
        plan.push(once(&COMPACT_STRATA, rows));
        plan.push(chunks(&STRATA, longest, rows));
    }
}

impl FrameSpec {
    fn refine_sources(&self, entry: Source) -> Vec<Source> {
        let of_tracing = [wgsl!("wgsl/supersample/contrast_range.wgsl"), wgsl!("wgsl/supersample/refine_trace.wgsl"), entry];
        let entry = refined_sources().into_iter().chain(of_tracing);
        self.extra().tracing_sources_from(wgsl!("wgsl/adaptive/attributes_atomic.wgsl"), self.hit(), entry)
    }
}

/// The sources of the state of refined pixels.
fn refined_sources() -> [Source; 4] {
    [
        wgsl!("wgsl/supersample/refine_list.wgsl"),
        wgsl!("wgsl/supersample/sample_order.wgsl"),
        wgsl!("wgsl/supersample/contrast.wgsl"),
        wgsl!("wgsl/supersample/refine.wgsl"),
    ]
}

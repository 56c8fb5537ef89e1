//! The lecture's adaptive supersampling: samples pixels at centre and corners and recursively divides quarters
//! that differ.

use super::{Output, Recipe, recipe::Storage, FrameSpec, stage::*, wgsl};
use crate::{
    device::shader::Source,
    frame::plan::{Band, Part, Plan, Rows, chunks, once, tiles},
};

stages! {
    /// Traces the centres and corners of all pixels.
    QUINCUNX_BASE = {
        name: "quincunx_base", wgsl: "passes/quincunx/quincunx_base.wgsl", paper: "lecture, \"Adaptive supersampling (1)\"",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours,
        clears: [Clears::ListHeader, Clears::Attributes],
        sources: |spec, entry| spec.quincunx_tracing_sources([spec.tile_order(), entry]),
    }
    /// Lists the samples that divide the quarters of pixels.
    QUINCUNX_SPLIT_A = {
        name: "quincunx_split_a", wgsl: "passes/quincunx/quincunx_split_a.wgsl", paper: "lecture, \"Adaptive supersampling (2)\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.quincunx_split_sources(entry),
    }
    /// Compacts the samples of the first division for indirect dispatch.
    COMPACT_QUINCUNX_A = {
        name: "compact_quincunx_a", wgsl: "passes/compact.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_step.wgsl"), entry),
    }
    /// Traces the samples of the first division.
    QUINCUNX_TRACE_A = {
        name: "quincunx_trace_a", wgsl: "passes/quincunx/quincunx_trace.wgsl", paper: "lecture, \"Adaptive supersampling (2)\"",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.quincunx_listed_sources(entry),
    }
    /// Lists the samples that divide the quarters of divided quarters.
    QUINCUNX_SPLIT_B = {
        name: "quincunx_split_b", wgsl: "passes/quincunx/quincunx_split_b.wgsl", paper: "lecture, \"Adaptive supersampling (2)\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.quincunx_split_sources(entry),
    }
    /// Compacts the samples of the second division for indirect dispatch.
    COMPACT_QUINCUNX_B = {
        name: "compact_quincunx_b", wgsl: "passes/compact.wgsl", paper: "ours",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_step.wgsl"), entry),
    }
    /// Traces the samples of the second division.
    QUINCUNX_TRACE_B = {
        name: "quincunx_trace_b", wgsl: "passes/quincunx/quincunx_trace.wgsl", paper: "lecture, \"Adaptive supersampling (2)\"",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.quincunx_listed_sources(entry),
    }
    /// Averages the samples of each pixel, weighted by the areas that they represent.
    QUINCUNX_RESOLVE = {
        name: "quincunx_resolve", wgsl: "passes/quincunx/quincunx_resolve.wgsl", paper: "lecture, \"Adaptive supersampling (3)\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut end = spec.output_sources(spec.output);
            end.push(entry);
            spec.quincunx_pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"), end)
        },
    }
}

/// The lecture's recursive supersampling with two levels of division.
pub const RECIPE: Recipe = Recipe { plan, traced: &QUINCUNX_BASE, interpolated: &[], storage: STORAGE };

/// A pixel stores and lists up to 32 samples of both levels. The height of a band is limited because list entries
/// hold coordinates in eighths of a pixel in 15 bits.
const STORAGE: Storage = Storage { radiances: 32, listed: 32, band_rows: Some(4000) };

/// The base samples, then two levels of division: each finds the samples to trace and traces them.
fn plan(plan: &mut Plan, _: &FrameSpec, band: &Band) {
    let ([width, _], [row, end]) = (plan.grid, band.own);
    let rows = Rows { stride: 1, row, end, turn: row };
    plan.stored_rows = plan.stored_rows.max(end - row);
    let with_corners = Rows { end: end + 1, ..rows };
    let base = tiles(&QUINCUNX_BASE, 2 * (width + 1), with_corners);
    plan.push(base.into_iter().map(|part| Part { rows, ..part }).collect());
    let pixels = (width + 1) * (end - row + 1);
    for (split, compact, trace, side, samples) in [
        (&QUINCUNX_SPLIT_A, &COMPACT_QUINCUNX_A, &QUINCUNX_TRACE_A, 2, 6),
        (&QUINCUNX_SPLIT_B, &COMPACT_QUINCUNX_B, &QUINCUNX_TRACE_B, 4, 24),
    ] {
        let quads = tiles(split, side * width, Rows { end: row + side * (end - row), ..rows });
        plan.push(quads.into_iter().map(|part| Part { rows, ..part }).collect());
        plan.lists(samples * pixels);
        plan.push(once(compact, rows));
        plan.push(chunks(trace, samples * pixels, rows));
    }
    plan.push(tiles(&QUINCUNX_RESOLVE, width, rows));
}

impl FrameSpec {
    fn quincunx_tracing_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let nowhere = Self { output: Output::Nowhere, ..*self };
        let shared =
            [wgsl!("wgsl/supersample/contrast.wgsl"), wgsl!("wgsl/supersample/quincunx.wgsl"), wgsl!("wgsl/supersample/quincunx_ray.wgsl")];
        nowhere.tracing_sources(shared.into_iter().chain(entry))
    }

    fn quincunx_listed_sources(&self, entry: Source) -> Vec<Source> {
        self.quincunx_tracing_sources([wgsl!("wgsl/adaptive/list.wgsl"), wgsl!("wgsl/supersample/quincunx_list.wgsl"), entry])
    }

    fn quincunx_split_sources(&self, entry: Source) -> Vec<Source> {
        self.quincunx_pixel_sources(
            wgsl!("wgsl/supersample/quincunx_split.wgsl"),
            [
                wgsl!("wgsl/adaptive/list.wgsl"),
                wgsl!("wgsl/adaptive/list_append.wgsl"),
                wgsl!("wgsl/supersample/quincunx_list.wgsl"),
                entry,
            ],
        )
    }

    fn quincunx_pixel_sources(
        &self,
        attributes: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        let mut sources = self.pixel_sources(attributes);
        sources.extend([wgsl!("wgsl/supersample/contrast.wgsl"), wgsl!("wgsl/supersample/quincunx.wgsl")]);
        sources.extend(entry);
        sources
    }
}

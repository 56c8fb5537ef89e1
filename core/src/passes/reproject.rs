//! Reprojection: shows the last frame's points where the camera sees them now and traces pixels that are lost or
//! due.

use super::{Recipe, FrameSpec, recipe::{Loops, Storage}, stage::*, wgsl};
use crate::{
    device::shader::Source,
    frame::plan::{Band, Plan, tiles},
};

stages! {
    /// Finds the depth of the nearest reprojected point in each pixel.
    REPROJECT_DEPTH = {
        name: "reproject_depth", wgsl: "passes/reproject/reproject_depth.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No,
        clears: [Clears::ListHeader, Clears::Reprojected],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Finds the pixel of the last frame that the nearest point comes from.
    REPROJECT_SOURCE = {
        name: "reproject_source", wgsl: "passes/reproject/reproject_source.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Shows reprojected points and lists the pixels to trace.
    REUSE = {
        name: "reuse", wgsl: "passes/reproject/reuse.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
            sources.extend(spec.output_sources(spec.output));
            sources.extend([
                wgsl!("wgsl/adaptive/list.wgsl"),
                wgsl!("wgsl/adaptive/list_append.wgsl"),
                wgsl!("wgsl/reproject/refresh.wgsl"),
                wgsl!("wgsl/reproject/history_before.wgsl"),
                wgsl!("wgsl/reproject/history.wgsl"),
                entry,
            ]);
            sources
        },
    }
    /// Compacts the list of pixels to trace for indirect dispatch.
    COMPACT_REFRESH = {
        name: "compact_refresh", wgsl: "passes/compact.wgsl", paper: "Kim 2016, 5",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/adaptive/list_range_step.wgsl"), entry),
    }
    /// Traces the listed pixels.
    REFRESH = {
        name: "refresh", wgsl: "passes/reproject/refresh.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| {
            spec.tracing_sources([wgsl!("wgsl/adaptive/list.wgsl"), wgsl!("wgsl/reproject/history.wgsl"), entry])
        },
    }
}

/// The lecture's reprojection, over the whole frame as one band.
pub const RECIPE: Recipe = Recipe {
    plan,
    traced: &REFRESH, storage: Storage { listed: 1, ..Storage::WHOLE },
    interpolated: &[
        (&REUSE, Loops::Repeated(4.0)),
        (&REPROJECT_DEPTH, Loops::Repeated(0.0)),
        (&REPROJECT_SOURCE, Loops::Repeated(0.0)),
    ],
};

/// The nearest depth in each pixel, its source, reuse or listing, and the tracing of listed pixels.
fn plan(plan: &mut Plan, _: &FrameSpec, band: &Band) {
    let ([width, _], rows) = (plan.grid, band.rows(1, band.own));
    for stage in [&REPROJECT_DEPTH, &REPROJECT_SOURCE, &REUSE] {
        plan.push(tiles(stage, width, rows));
    }
    plan.traces([&COMPACT_REFRESH, &REFRESH], width, rows);
}

impl FrameSpec {
    fn reprojection_sources(&self, entry: Source) -> Vec<Source> {
        vec![
            self.constants(),
            wgsl!("wgsl/trace/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/reproject/history_before.wgsl"),
            wgsl!("wgsl/reproject/reproject.wgsl"),
            entry,
        ]
    }
}

//! Reprojection: points of the frame before are shown where they are seen now; what is lost or old is traced.

use super::{Recipe, FrameSpec, recipe::{Loops, Storage}, stage::*, wgsl};
use crate::{
    device::shader::Source,
    frame::plan::{Band, Plan, tiles},
};

stages! {
    /// Finds the nearest reprojected point of each pixel.
    REPROJECT_DEPTH = {
        name: "reproject_depth", wgsl: "passes/reproject/reproject_depth.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No,
        clears: [Clears::ListHeader, Clears::Reprojected],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Finds the pixel that this point comes from.
    REPROJECT_SOURCE = {
        name: "reproject_source", wgsl: "passes/reproject/reproject_source.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Shows reprojected points again and lists the other pixels.
    REUSE = {
        name: "reuse", wgsl: "passes/reproject/reuse.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
            sources.extend(spec.output.sources());
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

/// The lecture's reprojection.
pub const RECIPE: Recipe = Recipe {
    plan,
    traced: &REFRESH, storage: Storage { listed: 1, ..Storage::WHOLE },
    interpolated: &[
        (&REUSE, Loops::Repeated(4.0)),
        (&REPROJECT_DEPTH, Loops::Repeated(0.0)),
        (&REPROJECT_SOURCE, Loops::Repeated(0.0)),
    ],
};

/// The nearest point in each pixel, whose it is, what is lost, and rays for that.
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

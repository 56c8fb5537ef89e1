//! Reprojection: points of the frame before are shown where they are seen now; what is lost or old is traced.

use super::{Recipe, FrameSpec, recipe::{Loops, Storage}, stage::*, wgsl};
use crate::{
    gpu::shader::Source,
    plan::{Band, Plan, tiles},
};

stages! {
    /// Finds the nearest reprojected point of each pixel.
    REPROJECT_DEPTH = {
        name: "reproject_depth", wgsl: "passes/reproject_depth.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No,
        clears: [Clears::ListHeader, Clears::Landed],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Finds the pixel that this point comes from.
    REPROJECT_SOURCE = {
        name: "reproject_source", wgsl: "passes/reproject_source.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.reprojection_sources(entry),
    }
    /// Shows reprojected points again and lists the other pixels.
    REUSE = {
        name: "reuse", wgsl: "passes/reuse.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = spec.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
            sources.extend(spec.output.sources());
            sources.extend([
                wgsl!("wgsl/list.wgsl"),
                wgsl!("wgsl/list_append.wgsl"),
                wgsl!("wgsl/renewal.wgsl"),
                wgsl!("wgsl/history_before.wgsl"),
                wgsl!("wgsl/history.wgsl"),
                entry,
            ]);
            sources
        },
    }
    /// Compacts the list of pixels to trace for indirect dispatch.
    COMPACT_RENEW = {
        name: "compact_renew", wgsl: "passes/compact.wgsl", paper: "Kim 2016, 5",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/list_step.wgsl"), entry),
    }
    /// Traces the listed pixels.
    RENEW = {
        name: "renew", wgsl: "passes/renew.wgsl", paper: "lecture, \"Reprojection\"",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| {
            spec.tracing_sources([wgsl!("wgsl/list.wgsl"), wgsl!("wgsl/history.wgsl"), entry])
        },
    }
}

/// The lecture's reprojection.
pub const RECIPE: Recipe = Recipe {
    plan,
    traced: &RENEW, storage: Storage { listed: 1, ..Storage::WHOLE },
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
    plan.traces([&COMPACT_RENEW, &RENEW], width, rows);
}

impl FrameSpec {
    fn reprojection_sources(&self, entry: Source) -> Vec<Source> {
        vec![
            self.constants(),
            wgsl!("wgsl/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/history_before.wgsl"),
            wgsl!("wgsl/reproject.wgsl"),
            entry,
        ]
    }
}

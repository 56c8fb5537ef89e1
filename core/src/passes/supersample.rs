//! Selective supersampling (Jin 2009): traces every pixel's centre, then extra samples in the subpixels that
//! differ.

use super::{Recipe, recipe::Storage, FrameSpec, refine, stage::*, wgsl};
use crate::{
    Jitter, Settings,
    device::shader::Source,
    frame::plan::{Band, Plan, Rows, chunks, once, tiles},
};

stages! {
    /// Traces a sample at every pixel's centre.
    PRESAMPLE = {
        name: "presample", wgsl: "passes/supersample/presample.wgsl", paper: "Jin 2009, 4.3.1",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.tracing_sources([spec.tile_order(), entry]),
    }
    /// Lists the subpixels that differ from their neighbours.
    SUBPIXEL_TEST = {
        name: "subpixel_test", wgsl: "passes/supersample/subpixel_test.wgsl", paper: "Jin 2009, 4.3.2",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::No, clears: [Clears::ListHeader],
        sources: |spec, entry| {
            let list = [wgsl!("wgsl/adaptive/list.wgsl"), wgsl!("wgsl/adaptive/list_append.wgsl"), wgsl!("wgsl/supersample/active_subpixels.wgsl")];
            spec.test_sources(list, entry)
        },
    }
    /// Compacts the list of active subpixels for indirect dispatch.
    COMPACT_ACTIVE = {
        name: "compact_active", wgsl: "passes/compact.wgsl", paper: "Jin 2009, 4.3.2",
        work: Work::Fixed, tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.compact_sources(wgsl!("wgsl/supersample/list_range_subpixels.wgsl"), entry),
    }
    /// Traces four extra samples in each active subpixel.
    EXTRA_SAMPLES = {
        name: "extra_samples", wgsl: "passes/supersample/extra_samples.wgsl", paper: "Jin 2009, 4.3.3",
        work: Work::List, tracing: Tracing::Listed, clears: [],
        sources: |spec, entry| spec.extra().tracing_sources([
            wgsl!("wgsl/adaptive/list.wgsl"),
            wgsl!("wgsl/supersample/active_subpixels.wgsl"),
            wgsl!("wgsl/supersample/sample_order.wgsl"),
            spec.unsampled(),
            entry,
        ]),
    }
}

/// Selective supersampling (Jin 2009).
pub const RECIPE: Recipe = Recipe { plan, traced: &PRESAMPLE, storage: Storage::NONE, interpolated: &[] };

/// The most extra samples of a pixel.
const EXTRA_SAMPLES_MOST: u32 = 16;

fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let (rows, stored) = band.alone(plan.grid[1], 1);
    plan.stored_rows = plan.stored_rows.max(stored.count());
    plan.push(tiles(&PRESAMPLE, plan.grid[0], stored));
    extra(plan, spec, rows);
}

/// Adds the passes of extra samples (Jin 2009, 4.1.3 and 4.1.4) for pixels that already have a sample.
pub fn extra(plan: &mut Plan, spec: &FrameSpec, rows: Rows) {
    if spec.settings.refines() {
        return refine::plan(plan, rows);
    }
    let longest = EXTRA_SAMPLES_MOST * plan.grid[0] * rows.count();
    plan.lists(longest);
    plan.push(tiles(&SUBPIXEL_TEST, plan.grid[0], rows));
    plan.push(once(&COMPACT_ACTIVE, rows));
    plan.push(chunks(&EXTRA_SAMPLES, longest, rows));
}

impl FrameSpec {
    /// The sources of a kernel that selects where extra samples go.
    pub(super) fn test_sources(&self, list: impl IntoIterator<Item = Source>, entry: Source) -> Vec<Source> {
        let mut sources = self.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
        sources.extend(list);
        sources.extend([
            wgsl!("wgsl/supersample/pixel_edges.wgsl"),
            wgsl!("wgsl/supersample/contrast.wgsl"),
            wgsl!("wgsl/supersample/contrast_range.wgsl"),
            wgsl!("wgsl/supersample/subpixels.wgsl"),
            self.unsampled(),
            self.tile_order(),
            entry,
        ]);
        sources.extend(self.output_sources(self.output));
        sources
    }

    /// This frame for kernels of extra samples: positions are jittered in their cells unless jitter is off.
    pub(super) fn extra(&self) -> Self {
        let jitter = if self.settings.jitter == Jitter::Off { Jitter::Off } else { Jitter::On };
        Self { secondary: false, ..self.with(Settings { jitter, ..self.settings }) }
    }
}

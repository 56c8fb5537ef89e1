//! Denoising of path-traced frames. It changes the displayed image; the accumulated sums of the samples stay.

use super::{FrameSpec, stage::*, wgsl};
use crate::{
    Denoise,
    device::shader::Source,
    frame::plan::{Part, Plan, Rows, tiles},
};

stages! {
    /// Replaces pixels whose path was stopped by the median of their neighbours.
    MEDIAN = {
        name: "median", wgsl: "passes/denoise/median.wgsl", paper: "Kim & Sung 2021, \"Noise Removal for the Stopped Ray\"",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.denoise_sources([entry]),
    }
    /// Prepares the pixels' light, without albedo and with fireflies clamped, for the a-trous filter.
    ATROUS_BEGIN = {
        name: "atrous_begin", wgsl: "passes/denoise/atrous_begin.wgsl", paper: "ours",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.denoise_sources([wgsl!("wgsl/denoise/atrous_buffer.wgsl"), entry]),
    }
    /// Filters the light with one level of the a-trous filter.
    ATROUS = {
        name: "atrous", wgsl: "passes/denoise/atrous.wgsl", paper: "Dammertz et al. 2010, section 2.2",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.atrous_sources(wgsl!("wgsl/denoise/atrous_next_level.wgsl"), entry),
    }
    /// Filters the light with the last level of the a-trous filter and writes the pixels.
    ATROUS_END = {
        name: "atrous_end", wgsl: "passes/denoise/atrous.wgsl", paper: "Dammertz et al. 2010, section 2.2",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.atrous_sources(wgsl!("wgsl/denoise/atrous_last_level.wgsl"), entry),
    }
}

/// Number of levels of the a-trous filter; each doubles the distance of the taps.
const ATROUS_LEVELS: u32 = 4;

/// Adds the passes of the denoiser.
pub fn plan(plan: &mut Plan, denoise: Denoise, width: u32, rows: Rows) {
    match denoise {
        Denoise::Off => {}
        Denoise::Median => plan.push(tiles(&MEDIAN, width, rows)),
        Denoise::Atrous => {
            plan.push(tiles(&ATROUS_BEGIN, width, rows));
            for level in 0..ATROUS_LEVELS {
                let stage = if level + 1 < ATROUS_LEVELS { &ATROUS } else { &ATROUS_END };
                let parts = tiles(stage, width, rows).into_iter();
                plan.push(parts.map(|part| Part { step: [1 << level; 2], ..part }).collect());
            }
        }
    }
}

impl FrameSpec {
    fn atrous_sources(&self, end: Source, entry: Source) -> Vec<Source> {
        self.denoise_sources([wgsl!("wgsl/denoise/atrous_buffer.wgsl"), wgsl!("wgsl/denoise/atrous.wgsl"), end, entry])
    }

    /// The sources of a kernel that denoises, ending with `entry`.
    fn denoise_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let mut sources = vec![
            self.constants(),
            wgsl!("wgsl/trace/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/scene/octahedral.wgsl"),
            wgsl!("wgsl/denoise/gbuffer.wgsl"),
            self.eyes(),
            wgsl!("wgsl/denoise/denoise_tap.wgsl"),
            self.tile_order(),
        ];
        sources.extend(self.path_sums());
        sources.extend(self.output_sources(self.output));
        sources.extend(entry);
        sources
    }
}

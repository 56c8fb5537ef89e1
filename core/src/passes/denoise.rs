//! Removal of the noise of paths, after all samples of a frame: what is shown changes, the sums of the samples do not.

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
    /// Prepares the light of all pixels for the a-trous filter.
    ATROUS_BEGIN = {
        name: "atrous_begin", wgsl: "passes/denoise/atrous_begin.wgsl", paper: "ours",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.denoise_sources([wgsl!("wgsl/denoise/atrous_buffer.wgsl"), entry]),
    }
    /// One level of the a-trous filter.
    ATROUS = {
        name: "atrous", wgsl: "passes/denoise/atrous.wgsl", paper: "Dammertz et al. 2010, section 2.2",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.atrous_sources(wgsl!("wgsl/denoise/atrous_next_level.wgsl"), entry),
    }
    /// The last level of the a-trous filter, which writes the pixels.
    ATROUS_END = {
        name: "atrous_end", wgsl: "passes/denoise/atrous.wgsl", paper: "Dammertz et al. 2010, section 2.2",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| spec.atrous_sources(wgsl!("wgsl/denoise/atrous_last_level.wgsl"), entry),
    }
}

/// Levels of the a-trous filter, each of which looks twice as far as the one before.
const ATROUS_LEVELS: u32 = 4;

/// The passes of one way to remove noise.
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

    /// What a kernel needs that treats noise of paths, and ends in these.
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
        sources.extend(self.output.sources());
        sources.extend(entry);
        sources
    }
}

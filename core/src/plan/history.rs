//! The plans of frames that keep something of the frames before them.

use super::{Extent, Part, Plan, Rows, SAMPLES_PER_SUBMISSION, Shape, tiles};
use crate::{
    passes::Stage,
    sequence::{RANK_TILE, RANKS},
};

/// Tiles that are renewed at once: bounded for a frame that traces all of them. Whatever their share, groups of threads
/// end with their last one.
const TILES: u32 = SAMPLES_PER_SUBMISSION / RANKS;

impl Plan {
    /// The lecture's frameless rendering.
    pub(super) fn frameless(&mut self, shape: &Shape, rows: Rows) {
        let count = shape.grid.map(|side| side.div_ceil(RANK_TILE)).iter().product::<u32>();
        let part = |first: u32| {
            let tiles = TILES.min(count - first);
            Part {
                stage: Stage::Frameless,
                rows,
                pass: 0,
                first,
                step: [0; 2],
                walk: 0,
                extent: Extent::Renewed(tiles),
                bounds: [first == 0, first + tiles == count],
                samples: tiles * RANKS,
            }
        };
        self.push((0..count).step_by(TILES as usize).map(part).collect());
    }

    /// The lecture's reprojection: the nearest point in each pixel, whose it is, what is lost, and rays for that.
    pub(super) fn reproject(&mut self, shape: &Shape, rows: Rows) {
        let [width, _] = shape.grid;
        for stage in [Stage::ReprojectDepth, Stage::ReprojectSource, Stage::Reuse] {
            self.push(tiles(stage, width, rows));
        }
        self.traces([Stage::CompactRenew, Stage::Renew], width, rows);
    }
}

//! Frames with several samples a pixel that are no even grids, or are more than averaged.

use super::{Band, Part, Plan, Rows, Shape, chunks, once, tiles};
use crate::{
    Denoise,
    passes::{REFINE_MOST, REFINE_STEP, Stage},
};

/// The most samples that a pixel gets besides its own.
const EXTRA_SAMPLES: u32 = 16;

/// Rounds of pixels that are refined: a line is followed over fewer pixels from where a centre hits it.
pub const REFINE_ROUNDS: u32 = 16;

/// What is listed after the first is this part of the frame at most.
const REFINE_LATER: u32 = 8;

/// Levels of the a-trous filter, each of which looks twice as far as the one before.
const ATROUS_LEVELS: u32 = 4;

impl Plan {
    /// A path through every pixel, and what is done about their noise.
    pub(super) fn paths(&mut self, shape: &Shape, rows: Rows) {
        let width = shape.grid[0];
        self.push(tiles(Stage::Path, width, rows));
        if shape.crosses {
            self.push(tiles(Stage::Look, width, rows));
            self.push(tiles(Stage::Cross, width, rows));
        }
        match shape.denoise {
            Denoise::Off => {}
            Denoise::Median => self.push(tiles(Stage::Median, width, rows)),
            Denoise::Atrous => {
                self.push(tiles(Stage::AtrousBegin, width, rows));
                for level in 0..ATROUS_LEVELS {
                    let stage = if level + 1 < ATROUS_LEVELS { Stage::Atrous } else { Stage::AtrousEnd };
                    let parts = tiles(stage, width, rows).into_iter();
                    self.push(parts.map(|part| Part { step: [1 << level; 2], ..part }).collect());
                }
            }
        }
    }

    /// Jin 2009, 4.1.3 and 4.1.4, for pixels that are there.
    pub(super) fn supersample(&mut self, shape: &Shape, rows: Rows) {
        if shape.refines {
            return self.refine(shape, rows);
        }
        let longest = EXTRA_SAMPLES * shape.grid[0] * rows.count();
        self.longest_list = self.longest_list.max(longest);
        self.push(tiles(Stage::SubpixelTest, shape.grid[0], rows));
        self.push(once(Stage::CompactActive, rows));
        self.push(chunks(Stage::ExtraSamples, longest, rows));
    }

    /// All pixels that the test finds and what they lead to; then the cells in them that differ.
    fn refine(&mut self, shape: &Shape, rows: Rows) {
        let pixels = shape.grid[0] * rows.count();
        let longest = REFINE_MOST / REFINE_STEP * pixels;
        self.longest_list = self.longest_list.max(longest);
        self.push(tiles(Stage::RefineTest, shape.grid[0], rows));
        for round in 0..REFINE_ROUNDS {
            let most = if round == 0 { longest } else { longest.div_ceil(REFINE_LATER) };
            self.push(once(Stage::CompactRefine, rows));
            self.push(chunks(Stage::Refine, most, rows));
        }
        self.push(once(Stage::CompactCellTest, rows));
        self.push(chunks(Stage::CellTest, pixels, rows));
        for _ in 1..REFINE_MOST / REFINE_STEP {
            self.push(once(Stage::CompactCells, rows));
            self.push(chunks(Stage::Cells, longest, rows));
        }
    }

    /// Pixels that samples of their neighbours count for, too.
    pub(super) fn filtered(&mut self, shape: &Shape, band: &Band) {
        let ([width, height], sampling) = (shape.grid, shape.sampling);
        let (rows, stored) = band.alone(height, sampling);
        self.stored_rows = self.stored_rows.max(stored.count());
        self.push(tiles(Stage::Full, width, stored));
        let pixels = Rows { row: rows.row / sampling, end: rows.end / sampling, ..rows };
        self.push(tiles(Stage::Resolve, width / sampling, pixels));
    }

    /// The lecture's recursion, two levels of it, each of which finds what to trace and traces it.
    pub(super) fn quincunx(&mut self, width: u32, band: &Band) {
        let [row, end] = band.own;
        let rows = Rows { stride: 1, row, end, turn: row };
        self.stored_rows = self.stored_rows.max(end - row);
        let with_corners = Rows { end: end + 1, ..rows };
        let base = tiles(Stage::QuincunxBase, 2 * (width + 1), with_corners);
        self.push(base.into_iter().map(|part| Part { rows, ..part }).collect());
        let pixels = (width + 1) * (end - row + 1);
        for (split, compact, trace, side, samples) in [
            (Stage::QuincunxSplitA, Stage::CompactQuincunxA, Stage::QuincunxTraceA, 2, 6),
            (Stage::QuincunxSplitB, Stage::CompactQuincunxB, Stage::QuincunxTraceB, 4, 24),
        ] {
            let quads = tiles(split, side * width, Rows { end: row + side * (end - row), ..rows });
            self.push(quads.into_iter().map(|part| Part { rows, ..part }).collect());
            self.longest_list = self.longest_list.max(samples * pixels);
            self.push(once(compact, rows));
            self.push(chunks(trace, samples * pixels, rows));
        }
        self.push(tiles(Stage::QuincunxResolve, width, rows));
    }
}

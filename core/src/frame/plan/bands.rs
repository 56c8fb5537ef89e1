//! Divides a frame into bands of rows, which bounds the memory for samples however fine their grid.
//!
//! A band ends with a row of base samples and the next one begins with the same row, which is traced once and
//! kept. Rows are stored like a folded strip of paper, every second band in reverse, so that the shared row has
//! the same storage location in both bands.

use super::Rows;

/// Bands have a multiple of this many rows, so that base blocks of every size end with the band, on an even row.
const STEP: u32 = 16;

/// Rows of a band when `most` rows fit into its buffers, the shared row included; at least the smallest possible
/// band.
pub fn band_rows(sampling: u32, most: u64) -> u32 {
    let shared =
        (1..=STEP).filter(|n| STEP.is_multiple_of(*n) && sampling.is_multiple_of(*n)).max().unwrap_or(1);
    let step = STEP / shared * sampling;
    let most = u32::try_from(most).unwrap_or(u32::MAX).saturating_sub(1);
    (most / step).max(1).saturating_mul(step)
}

/// A band of consecutive rows of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Band {
    /// First row; it may already be there from the band before.
    pub first: u32,
    /// Start and end of the rows that belong to this band alone.
    pub own: [u32; 2],
    /// Row after the last one. The last row is a base row, except at the end of the frame.
    pub end: u32,
    /// Row y is stored as row |y - turn| of the buffers.
    pub turn: u32,
    /// Whether the band before has already made the first row.
    follows: bool,
}

/// The bands of a frame of `height` rows; each has `rows` rows besides the shared one.
pub fn bands(height: u32, rows: u32) -> impl Iterator<Item = Band> {
    // A last band of a single row would not be worth its passes, so the last band may be one row longer.
    let count = height.saturating_sub(1).div_ceil(rows).max(1);
    (0..count).map(move |index| {
        let first = index * rows;
        let last = index + 1 == count;
        Band {
            first,
            own: [first, if last { height } else { first + rows }],
            end: if last { height } else { first + rows + 1 },
            turn: if index % 2 == 0 { first } else { first + rows },
            follows: index > 0,
        }
    })
}

impl Band {
    /// The band's own rows in a frame of `height` rows, and these with `apron` more rows above and below, which
    /// neighbouring pixels lie in. For methods whose bands share no row.
    pub fn alone(&self, height: u32, apron: u32) -> (Rows, Rows) {
        let [first, end] = self.own;
        let turn = first.saturating_sub(apron);
        let rows = |row, end| Rows { stride: 1, row, end, turn };
        (rows(first, end), rows(turn, (end + apron).min(height)))
    }

    /// Every `stride`-th row of `row..end` in this band.
    pub fn rows(&self, stride: u32, [row, end]: [u32; 2]) -> Rows {
        Rows { stride, row, end, turn: self.turn }
    }

    /// The rows of references that are `stride` rows apart.
    pub fn base(&self, stride: u32) -> Rows {
        let row = if self.follows { self.first + stride } else { self.first };
        self.rows(stride, [row, self.end])
    }

    /// The rows half way between references that are `stride` rows apart.
    pub fn between(&self, stride: u32) -> Rows {
        self.rows(stride, [self.first + stride / 2, self.end])
    }

    /// The rows of pixels, each `sampling` rows of samples high, that belong to this band.
    pub fn pixels(&self, sampling: u32) -> Rows {
        self.rows(1, self.own.map(|row| row / sampling))
    }
}

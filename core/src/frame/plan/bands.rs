//! A frame in bands of rows, so that what is stored of its samples stays small however fine the grid.
//!
//! A band ends on a row of base samples, and the next one begins with it: it is traced once and kept. Rows are stored
//! folded like a strip of paper, every second band backwards, so that this row has the same place in both.

use super::Rows;

/// Rows of a band are a multiple of this: base blocks of every size end with it, on an even row.
const STEP: u32 = 16;

/// The most rows that a band may have of which `most` and the shared one fit, but at least as few as it can have.
pub fn band_rows(sampling: u32, most: u64) -> u32 {
    let shared =
        (1..=STEP).filter(|n| STEP.is_multiple_of(*n) && sampling.is_multiple_of(*n)).max().unwrap_or(1);
    let step = STEP / shared * sampling;
    let most = u32::try_from(most).unwrap_or(u32::MAX).saturating_sub(1);
    (most / step).max(1).saturating_mul(step)
}

/// A band of rows of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Band {
    /// The first row, which the band before may have made.
    pub first: u32,
    /// The rows that are this band's and no other's: from, until before.
    pub own: [u32; 2],
    /// Behind the last row, which is a base row unless the frame ends.
    pub end: u32,
    /// Row y is stored in row |y - turn|.
    pub turn: u32,
    /// Is the first row there already?
    follows: bool,
}

/// The bands of a frame of so many rows, `rows` each besides the shared one.
pub fn bands(height: u32, rows: u32) -> impl Iterator<Item = Band> {
    // A band of one row is not worth its passes: the last band may be a row longer.
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
    /// Its own rows in a frame of that height, and all rows that are stored when bands share none: with so many rows above and
    /// below, which their neighbours are in.
    pub fn alone(&self, height: u32, apron: u32) -> (Rows, Rows) {
        let [first, end] = self.own;
        let turn = first.saturating_sub(apron);
        let rows = |row, end| Rows { stride: 1, row, end, turn };
        (rows(first, end), rows(turn, (end + apron).min(height)))
    }

    /// Every `stride`-th of these rows.
    pub fn rows(&self, stride: u32, [row, end]: [u32; 2]) -> Rows {
        Rows { stride, row, end, turn: self.turn }
    }

    /// The rows of references at that distance.
    pub fn base(&self, stride: u32) -> Rows {
        let row = if self.follows { self.first + stride } else { self.first };
        self.rows(stride, [row, self.end])
    }

    /// The rows half way between them.
    pub fn between(&self, stride: u32) -> Rows {
        self.rows(stride, [self.first + stride / 2, self.end])
    }

    /// The rows of pixels whose samples are there.
    pub fn pixels(&self, sampling: u32) -> Rows {
        self.rows(1, self.own.map(|row| row / sampling))
    }
}

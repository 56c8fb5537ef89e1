//! The quality levels of the governor, from the best to the fastest.

use glimpse::{Postcorrect, Settings};

/// Quality of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Index of the level, 0 the best; `None` for a frame at rest, at the chosen quality.
    pub level: Option<usize>,
    /// Ratio of the frame's side to the view's: a multiple of 1/64 in (0, 1].
    pub scale: f32,
    /// The least block size.
    pub block: u32,
    /// Factor on the tolerances, at least 1.
    pub relax: f32,
}

impl Quality {
    /// The chosen quality, unreduced.
    pub const FULL: Self = Self { level: None, scale: 1.0, block: 2, relax: 1.0 };

    /// The chosen settings with this quality applied.
    #[must_use]
    pub fn settings(&self, chosen: &Settings) -> Settings {
        if self.level.is_none() {
            return *chosen;
        }
        Settings {
            block: chosen.block.max(self.block),
            // Postcorrection repairs single frames, which are replaced immediately in motion. The frame at
            // rest has it again.
            postcorrect: match chosen.postcorrect {
                Postcorrect::Auto => Postcorrect::Off,
                wished => wished,
            },
            tolerances: chosen.tolerances.relaxed(self.relax),
            ..*chosen
        }
    }

    /// The frame's side for a view's side, both in pixels: at least one.
    #[must_use]
    pub fn pixels(&self, view: u32) -> u32 {
        ((f64::from(view) * f64::from(self.scale)).round() as u32).max(1)
    }
}

/// A quality level.
pub(super) struct Level {
    pub scale: f32,
    pub block: u32,
    pub relax: f32,
    /// Time of a pixel relative to one at the best level, measured as a mean over scenes; the governor
    /// corrects it by the reports.
    pub work: f64,
}

const fn level(scale: f32, block: u32, relax: f32, work: f64) -> Level {
    Level { scale, block, relax, work }
}

/// Each level has 0.69 to 0.81 times the pixels of the previous one, a step that is seldom visible. A block size of 4
/// takes 0.87 times the time of 2 and loses little quality; 8 is no faster than 4, so no level has it.
pub(super) const LADDER: [Level; 16] = [
    level(1.0, 2, 1.0, 1.0),
    level(0.875, 2, 1.0, 1.0),
    level(0.75, 2, 1.0, 1.0),
    level(0.625, 2, 1.0, 1.0),
    level(0.5625, 2, 1.25, 0.97),
    level(0.5, 4, 1.25, 0.87),
    level(0.4375, 4, 1.25, 0.87),
    level(0.375, 4, 1.5, 0.85),
    level(0.3125, 4, 1.5, 0.85),
    level(0.28125, 4, 1.5, 0.85),
    level(0.25, 4, 2.0, 0.83),
    level(0.21875, 4, 2.0, 0.83),
    level(0.1875, 4, 2.0, 0.83),
    level(0.15625, 4, 2.0, 0.83),
    level(0.140_625, 4, 2.0, 0.83),
    level(0.125, 4, 2.0, 0.83),
];

impl Level {
    /// Ratio of the frame's pixels to the view's.
    pub fn area(&self) -> f64 {
        f64::from(self.scale).powi(2)
    }

    /// Time of a frame relative to one at the best level.
    pub fn share(&self) -> f64 {
        self.area() * self.work
    }
}

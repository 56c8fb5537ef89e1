//! The levels of quality, from the best to the fastest.

use glimpse::{Postcorrect, Settings, Tolerances};

/// How a frame is to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// The level of the ladder, 0 the best; `None` at rest, where everything is as it was chosen.
    pub level: Option<usize>,
    /// Pixels of the frame along a side, over those of the view: a multiple of 1/64 in (0, 1].
    pub scale: f32,
    /// The least side of a block.
    pub block: u32,
    /// The tolerances are wider by this factor, at least 1.
    pub relax: f32,
}

impl Quality {
    /// Everything as it was chosen.
    pub const FULL: Self = Self { level: None, scale: 1.0, block: 2, relax: 1.0 };

    /// What was chosen, as this quality changes it.
    #[must_use]
    pub fn settings(&self, chosen: &Settings) -> Settings {
        let t = &chosen.tolerances;
        if self.level.is_none() {
            return *chosen;
        }
        // A bound on a cosine: its distance from 1 grows, as far as cosines go. One that is out of reach stays so.
        let norm = (1.0 - (1.0 - t.norm) * self.relax).clamp(t.norm.min(-1.0), t.norm);
        Settings {
            block: chosen.block.max(self.block),
            // What it repairs is gone with the next frame, and comes back at rest.
            postcorrect: match chosen.postcorrect {
                Postcorrect::Auto => Postcorrect::Off,
                wished => wished,
            },
            tolerances: Tolerances {
                pos: (t.pos * self.relax).min(f32::MAX),
                norm,
                // The border zone of a texture: narrower is looser.
                tex: t.tex / self.relax,
                gcol: (t.gcol * self.relax).min(f32::MAX),
            },
            ..*chosen
        }
    }

    /// Pixels along a side of a view of so many: at least one.
    #[must_use]
    pub fn pixels(&self, view: u32) -> u32 {
        ((f64::from(view) * f64::from(self.scale)).round() as u32).max(1)
    }
}

/// A level of the ladder.
pub(super) struct Level {
    pub scale: f32,
    pub block: u32,
    pub relax: f32,
    /// Time of a pixel over that of a pixel of the best level, as measured on average; the rest is learned from frames.
    pub work: f64,
}

const fn level(scale: f32, block: u32, relax: f32, work: f64) -> Level {
    Level { scale, block, relax, work }
}

/// A level has 0.69 to 0.81 times the pixels of the one before it: a step is seldom seen. Blocks of 4 take 0.87 times the
/// time of those of 2 and lose little (README, larger blocks); those of 8 take no less, so they are not here.
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
    /// Pixels of a frame over those of the view.
    pub fn area(&self) -> f64 {
        f64::from(self.scale).powi(2)
    }

    /// Time of a frame over that of a frame of the best level.
    pub fn share(&self) -> f64 {
        self.area() * self.work
    }
}

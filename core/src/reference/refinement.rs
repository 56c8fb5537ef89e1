//! Extra samples for whole pixels, step by step: `refine.wgsl` in f64.

use glam::DVec3;

use super::{
    Frame, Rounding,
    contrast::{contrasts, exceeds, shown},
};
use crate::{Jitter, plan::REFINE_ROUNDS};

/// What the eight samples of a pixel must exceed the least threshold by to become sixteen.
const LAST_CONTRAST: f64 = 4.0;

/// How a pixel is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refinement {
    /// In which round, 0 the first.
    pub round: Option<u32>,
    /// How many samples it gets besides its own: 0, 4, 8, 16, fewer where the rounds end.
    pub samples: u32,
}

impl Frame<'_> {
    /// Whether and when a pixel is refined, given when its neighbours are.
    #[must_use]
    pub fn refinement(
        &self,
        pixel: [u32; 2],
        round_of: &dyn Fn([u32; 2]) -> Option<u32>,
        rounding: &mut Rounding,
    ) -> Refinement {
        let round = if self.tested(pixel, rounding).active == 0 {
            let before = self.around(pixel).filter_map(|q| Some((round_of(q)?, q)));
            let surprising = before.filter(|(_, q)| self.surprises(pixel, *q, rounding));
            surprising.map(|(round, _)| round + 1).min().filter(|round| *round < REFINE_ROUNDS)
        } else {
            Some(0)
        };
        let Some(first) = round else { return Refinement { round, samples: 0 } };
        let wanted = match () {
            () if !self.differs(pixel, 4, 1.0, rounding) => 4,
            () if !self.differs(pixel, 8, LAST_CONTRAST, rounding) => 8,
            () => 16,
        };
        Refinement { round, samples: wanted.min(4 * (REFINE_ROUNDS - first)) }
    }

    /// Linear radiance of a pixel that has so many samples besides its own.
    #[must_use]
    pub fn refined(&self, pixel: [u32; 2], samples: u32, rounding: &mut Rounding) -> DVec3 {
        let sum: DVec3 = (0..samples).map(|i| self.refining_sample(pixel, i, rounding)).sum();
        if samples == 16 {
            return sum / 16.0;
        }
        (sum + self.presampled(pixel, rounding).color) / f64::from(samples + 1)
    }

    /// Do the first samples of a neighbour show what no pixel around this one does?
    fn surprises(&self, pixel: [u32; 2], neighbour: [u32; 2], rounding: &mut Rounding) -> bool {
        let steps = (0..9).map(|i| [i % 3 - 1, i / 3 - 1]);
        let around: Vec<_> =
            steps.map(|step| shown(self.presampled(self.beside(pixel, step), rounding).color)).collect();
        let low = around.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = around.into_iter().fold(DVec3::ZERO, DVec3::max);
        (0..4).any(|i| {
            let found = shown(self.refining_sample(neighbour, i, rounding));
            let nearest = found.clamp(low, high);
            // They are compared as radiances.
            let pair = [found * found, nearest * nearest];
            exceeds(contrasts(pair.into_iter()).map(|c| rounding.contrast(c)), self.least_threshold())
        })
    }

    /// Do the centre and the first so many samples differ by so many times what is worth a sample?
    fn differs(&self, pixel: [u32; 2], samples: u32, factor: f64, rounding: &mut Rounding) -> bool {
        let own = self.presampled(pixel, rounding).color;
        let colors: Vec<_> = (0..samples).map(|i| self.refining_sample(pixel, i, rounding)).collect();
        let contrasts = contrasts(colors.into_iter().chain([own])).map(|c| rounding.contrast(c));
        exceeds(contrasts, factor * self.least_threshold())
    }

    /// In Sobol's order; samples that lie side by side are off alike.
    fn refining_sample(&self, pixel: [u32; 2], i: u32, rounding: &Rounding) -> DVec3 {
        let jitters = self.settings.jitter != Jitter::Off;
        let [a, b, c, d] = [0, 1, 2, 3].map(|bit| i >> bit & 1);
        let order = [2 * a + b, 2 * (a ^ b ^ c ^ d) + (b ^ d)];
        let cell = [0, 1].map(|axis| 4 * pixel[axis] + order[axis]);
        self.sample_in(cell, 4, jitters, &mut rounding.clone()).color
    }

    fn least_threshold(&self) -> f64 {
        self.settings.thresholds.values().into_iter().map(f64::from).fold(1.0, f64::min)
    }

    /// The neighbours inside the frame.
    fn around(&self, pixel: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let size = self.size;
        let steps = (0..9).filter(|i| *i != 4).map(|i| [i % 3 - 1, i / 3 - 1]);
        steps.filter_map(move |step: [i64; 2]| {
            let beside = [0, 1].map(|i| u32::try_from(i64::from(pixel[i]) + step[i]).unwrap_or(u32::MAX));
            (0..2).all(|i| beside[i] < size[i]).then_some(beside)
        })
    }
}

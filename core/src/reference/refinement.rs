//! Refinement of whole pixels in several steps: `refine.wgsl` and `stratum_test.wgsl` in f64.

use glam::DVec3;

use super::{
    ReferenceFrame, Rounding,
    contrast::{contrasts, exceeds, shown},
};
use crate::{
    Jitter,
    passes::{STRATUM_CONTRAST, refine::REFINE_ROUNDS},
};

/// Mask of the first four of the sixteen samples.
const FIRST: u32 = 0b1111;

/// When a pixel is refined and with which samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refinement {
    /// The round in which the pixel is refined, from 0; `None` if it is not.
    pub round: Option<u32>,
    /// Mask of the extra samples, as in [`crate::PixelRecord::strata`].
    pub strata: u32,
}

impl ReferenceFrame<'_> {
    /// Whether, when and in which strata a pixel is refined, given the rounds of its neighbours.
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
        if round.is_none() {
            return Refinement { round, strata: 0 };
        }
        let subpixels = self.subpixels_around(pixel, round_of, rounding);
        let differing = (4..16).filter(|i| self.stratum_differs(&subpixels, *i, rounding));
        let mut strata = differing.fold(0, |strata, i| strata | 1 << i);
        // Adds the next strata in sampling order until their number fills whole steps.
        for i in 4..16 {
            if u32::count_ones(strata) % 4 != 0 {
                strata |= 1 << i;
            }
        }
        Refinement { round, strata: strata | FIRST }
    }

    /// Linear radiance of a pixel with its own sample and these extra ones.
    #[must_use]
    pub fn refined(&self, pixel: [u32; 2], strata: u32, rounding: &mut Rounding) -> DVec3 {
        let sample = |i: u32| self.refining_sample(pixel, i, rounding);
        match strata {
            0 => self.presampled(pixel, rounding).color,
            FIRST => ((0..4).map(sample).sum::<DVec3>() + self.presampled(pixel, rounding).color) / 5.0,
            _ => {
                let nearest =
                    |i: u32| if strata >> i & 1 == 1 { i } else { in_subpixel(subpixel(stratum(i))) };
                (0..16).map(|i| sample(nearest(i))).sum::<DVec3>() / 16.0
            }
        }
    }

    /// Whether the first samples of a neighbour lie outside the range of colours in the pixels around this one.
    fn surprises(&self, pixel: [u32; 2], neighbour: [u32; 2], rounding: &mut Rounding) -> bool {
        let steps = (0..9).map(|i| [i % 3 - 1, i / 3 - 1]);
        let around: Vec<_> =
            steps.map(|step| shown(self.presampled(self.beside(pixel, step), rounding).color)).collect();
        let low = around.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = around.into_iter().fold(DVec3::ZERO, DVec3::max);
        (0..4).any(|i| {
            let found = shown(self.refining_sample(neighbour, i, rounding));
            let nearest = found.clamp(low, high);
            // The comparison expects radiances, the squares of display values.
            let pair = [found * found, nearest * nearest];
            exceeds(contrasts(pair.into_iter()).map(|c| rounding.contrast(c)), self.least_threshold())
        })
    }

    /// Colours of the 4x4 subpixels in and around a pixel, row by row from the upper left: of a refined pixel its
    /// samples, else the pixel's; beyond the frame, of the nearest inside.
    fn subpixels_around(
        &self,
        pixel: [u32; 2],
        round_of: &dyn Fn([u32; 2]) -> Option<u32>,
        rounding: &mut Rounding,
    ) -> [DVec3; 16] {
        std::array::from_fn(|i| {
            let step = [i % 4, i / 4].map(|place| place as i64 - 1);
            let last = self.size.map(|side| 2 * i64::from(side) - 1);
            let at = [0, 1].map(|axis| (2 * i64::from(pixel[axis]) + step[axis]).clamp(0, last[axis]) as u32);
            let owner = at.map(|place| place / 2);
            match round_of(owner) {
                Some(_) => self.refining_sample(owner, in_subpixel((at[0] & 1) + 2 * (at[1] & 1)), rounding),
                None => self.presampled(owner, rounding).color,
            }
        })
    }

    /// Whether the sample's subpixel differs from the three that meet it at the corner nearest to the sample's
    /// stratum.
    fn stratum_differs(&self, subpixels: &[DVec3; 16], sample: u32, rounding: &mut Rounding) -> bool {
        let stratum = stratum(sample).map(|place| place as usize);
        let own = stratum.map(|place| place / 2 + 1);
        let beside = [0, 1].map(|axis| own[axis] + 2 * (stratum[axis] & 1) - 1);
        let corner = [own, [beside[0], own[1]], [own[0], beside[1]], beside];
        let colors = corner.map(|[x, y]| subpixels[x + 4 * y]);
        let contrasts = contrasts(colors.into_iter()).map(|c| rounding.contrast(c));
        exceeds(contrasts, f64::from(STRATUM_CONTRAST) * self.least_threshold())
    }

    /// The sample's radiance, with rounding errors like those of its neighbouring samples.
    fn refining_sample(&self, pixel: [u32; 2], i: u32, rounding: &Rounding) -> DVec3 {
        let jitters = self.settings.jitter != Jitter::Off;
        let inside = stratum(i);
        let stratum = [0, 1].map(|axis| 4 * pixel[axis] + inside[axis]);
        self.sample_in(stratum, 4, jitters, &mut rounding.clone()).color
    }

    fn least_threshold(&self) -> f64 {
        self.settings.thresholds.values().into_iter().map(f64::from).fold(1.0, f64::min)
    }

    /// The up to eight neighbours inside the frame.
    fn around(&self, pixel: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let size = self.size;
        let steps = (0..9).filter(|i| *i != 4).map(|i| [i % 3 - 1, i / 3 - 1]);
        steps.filter_map(move |step: [i64; 2]| {
            let beside = [0, 1].map(|i| u32::try_from(i64::from(pixel[i]) + step[i]).unwrap_or(u32::MAX));
            (0..2).all(|i| beside[i] < size[i]).then_some(beside)
        })
    }
}

/// Cell of the i-th of sixteen samples, in Sobol' order.
fn stratum(i: u32) -> [u32; 2] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|bit| i >> bit & 1);
    [2 * a + b, 2 * (a ^ b ^ c ^ d) + (b ^ d)]
}

/// Subpixel of a stratum: 0 upper left, 1 upper right, 2 lower left, 3 lower right.
fn subpixel([x, y]: [u32; 2]) -> u32 {
    x / 2 + 2 * (y / 2)
}

/// Index of the sample in a subpixel, among the first four.
fn in_subpixel(subpixel: u32) -> u32 {
    [0, 3, 2, 1][subpixel as usize]
}

//! Selective and adaptive supersampling (Jin 2009): the subpixel test and the colour of a pixel with extra samples.

use glam::DVec3;

use super::{
    Attributes, Cause, Ray, ReferenceFrame, Rounding, Sample,
    attributes::stored_direction,
    contrast::{contrasts, exceeds},
    jitter::jitter,
};
use crate::{Jitter, Unsampled};

/// The result of the subpixel test of a pixel (Jin 2009, 4.1.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tested {
    /// Subpixels with extra samples, as bits of [`crate::PixelRecord::active`].
    pub active: u32,
    /// Attributes that differ from a neighbour's, as bits of [`crate::PixelRecord::differing`].
    pub differing: u32,
}

/// Attributes of a hit that the subpixel test compares (Jin 2009, Table 1).
#[derive(Clone, Copy, Debug)]
struct Edges {
    object: Option<u32>,
    normal: DVec3,
    shadow_count: u32,
    textured: bool,
}

/// Compared attributes of a pixel's primary and secondary hit, and its colour.
struct Compared {
    hits: [Edges; 2],
    color: DVec3,
}

impl ReferenceFrame<'_> {
    /// The ray through a cell of a grid `fineness` times as fine as that of the samples, and the length of its
    /// direction before normalisation.
    #[must_use]
    pub fn ray_in(&self, stratum: [u32; 2], fineness: u32, jitters: bool) -> (Ray, f64) {
        let inside = if jitters { jitter(stratum, self.settings.seed) } else { [0.5; 2] };
        let side = f64::from(fineness).recip();
        self.ray_at([0, 1].map(|i| side * (f64::from(stratum[i]) + inside[i])), side)
    }

    pub(super) fn sample_in(
        &self,
        stratum: [u32; 2],
        fineness: u32,
        jitters: bool,
        rounding: &mut Rounding,
    ) -> Sample {
        let (ray, length) = self.ray_in(stratum, fineness, jitters);
        self.followed(&ray, length, rounding)
    }

    /// The sample through the centre of a pixel.
    #[must_use]
    pub fn presampled(&self, pixel: [u32; 2], rounding: &mut Rounding) -> Sample {
        self.sample_in(pixel, 1, self.settings.jitter == Jitter::On, rounding)
    }

    /// The subpixel test: active subpixels and differing attributes.
    #[must_use]
    pub fn tested(&self, pixel: [u32; 2], rounding: &mut Rounding) -> Tested {
        let own = self.compared(pixel, rounding);
        let textures = bits([0, 1].map(|i| self.in_focus(own.hits[i].object) && own.hits[i].textured), 3);
        let mut tested = Tested { active: 0, differing: 0 };
        for subpixel in 0..4 {
            let [right, down] = [subpixel & 1, subpixel >> 1].map(|side| 2 * side as i64 - 1);
            let neighbours = [[right, 0], [0, down], [right, down]]
                .map(|[x, y]| self.compared(self.beside(pixel, [x, y]), rounding));
            let differing =
                neighbours.iter().fold(textures, |bits, other| bits | self.differing(&own, other));
            let colors = neighbours.iter().map(|n| n.color).chain([own.color]);
            let contrasts = contrasts(colors).map(|c| rounding.contrast(c));
            tested.active |= u32::from(exceeds(contrasts, self.threshold(differing))) << subpixel;
            let colored = exceeds(contrasts, self.settings.thresholds.col.into());
            tested.differing |= u32::from(colored) | differing << 1;
        }
        tested
    }

    /// Linear radiance of a pixel with extra samples in the active subpixels.
    #[must_use]
    pub fn supersampled(&self, pixel: [u32; 2], active: u32, rounding: &mut Rounding) -> DVec3 {
        let own = self.presampled(pixel, rounding).color;
        let subpixels = (0..4_u32).map(|subpixel| {
            let [right, down] = [subpixel & 1, subpixel >> 1];
            if active >> subpixel & 1 == 1 {
                let strata = [[0, 0], [1, 0], [0, 1], [1, 1]]
                    .map(|[x, y]| [4 * pixel[0] + 2 * right + x, 4 * pixel[1] + 2 * down + y]);
                let jitters = self.settings.jitter != Jitter::Off;
                // Neighbouring samples have similar rounding errors.
                let color = |c: &[u32; 2]| self.sample_in(*c, 4, jitters, &mut rounding.clone()).color;
                return strata.iter().map(color).sum::<DVec3>() / 4.0;
            }
            match self.settings.unsampled {
                Unsampled::Nearest => own,
                Unsampled::Bilinear => {
                    let [x, y] = [right, down].map(|side| 2 * i64::from(side) - 1);
                    let [beside, above, across] = [[x, 0], [0, y], [x, y]]
                        .map(|step| self.presampled(self.beside(pixel, step), rounding).color);
                    (9.0 * own + 3.0 * (beside + above) + across) / 16.0
                }
            }
        });
        subpixels.sum::<DVec3>() / 4.0
    }

    fn compared(&self, pixel: [u32; 2], rounding: &mut Rounding) -> Compared {
        let sample = self.presampled(pixel, rounding);
        let secondary = sample.secondary.unwrap_or_else(Attributes::miss);
        let hits = [&sample.attributes, &secondary].map(|a| self.edges(a, rounding));
        Compared { hits, color: sample.color }
    }

    fn edges(&self, a: &Attributes, rounding: &mut Rounding) -> Edges {
        Edges {
            object: a.object,
            normal: match a.object {
                Some(_) => stored_direction(rounding.direction(Cause::Storage, a.normal)),
                None => DVec3::ZERO,
            },
            shadow_count: a.shadow.count_ones(),
            textured: a.object.is_some_and(|object| self.reference.first_texture(object).is_some()),
        }
    }

    /// Mask of the differing attributes, in the order of Table 1.
    fn differing(&self, own: &Compared, other: &Compared) -> u32 {
        let bits_of = |i: usize| {
            let (a, b) = (&own.hits[i], &other.hits[i]);
            if !self.in_focus(a.object) && !self.in_focus(b.object) {
                return 0;
            }
            let both = a.object.is_some() && b.object.is_some();
            let bent = both
                && a.normal != b.normal
                && a.normal.dot(b.normal) <= f64::from(self.settings.tolerances.norm);
            u32::from(a.object != b.object)
                | u32::from(bent) << 1
                | u32::from(a.shadow_count != b.shadow_count) << 2
        };
        bits_of(0) | bits_of(1) << 4
    }

    fn in_focus(&self, object: Option<u32>) -> bool {
        self.settings
            .focus
            .is_none_or(|focus| object.is_some_and(|object| (focus.first..=focus.last).contains(&object)))
    }

    fn threshold(&self, differing: u32) -> f64 {
        let [col, of_attributes @ ..] = self.settings.thresholds.values();
        let differing = (0..8).filter(|i| differing >> i & 1 == 1).map(|i| of_attributes[i]);
        f64::from(differing.reduce(f32::min).unwrap_or(col))
    }

    /// The neighbouring pixel, clamped to the frame.
    pub(super) fn beside(&self, pixel: [u32; 2], step: [i64; 2]) -> [u32; 2] {
        [0, 1].map(|i| (i64::from(pixel[i]) + step[i]).clamp(0, i64::from(self.size[i]) - 1) as u32)
    }
}

/// The bits of one attribute, for the primary and the secondary hit.
fn bits([primary, secondary]: [bool; 2], bit: u32) -> u32 {
    u32::from(primary) << bit | u32::from(secondary) << (bit + 4)
}

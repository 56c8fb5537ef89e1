//! A frame: its primary rays, `full` and `adaptive`. Every pixel is worked out by itself, with all that it depends on.

use glam::DVec3;

use super::{Attributes, Limits, Ray, Reference, Rounding, Sample, similarity::Reached};
use crate::{Camera, Origin, Settings};

/// A frame of a scene.
pub struct Frame<'a> {
    /// What is seen.
    pub reference: &'a Reference,
    /// From where.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How.
    pub settings: Settings,
}

/// A pixel of an adaptive frame.
#[derive(Clone, Copy, Debug)]
pub struct Pixel {
    /// How it came to be.
    pub origin: Origin,
    /// The checks that fail between its two references, as bits in the order of [`crate::CHECK_NAMES`].
    pub failed: u32,
    /// Before they are stored.
    pub attributes: Attributes,
    /// Linear radiance.
    pub color: DVec3,
}

impl Frame<'_> {
    /// The ray through a pixel's centre, and the length of its direction, in whose units depths are.
    #[must_use]
    pub fn ray(&self, [x, y]: [u32; 2]) -> (Ray, f64) {
        let [width, height] = self.size.map(f64::from);
        let right = (2.0 * (f64::from(x) + 0.5) - width) / height * self.camera.right.as_dvec3();
        let up = (height - 2.0 * (f64::from(y) + 0.5)) / height * self.camera.up.as_dvec3();
        let (eye, forward) = (self.camera.origin.as_dvec3(), self.camera.forward.as_dvec3());
        let (origin, along) = match self.camera.orthographic {
            true => (eye + right + up, forward),
            false => (eye, forward + right + up),
        };
        let length = along.length();
        (Ray { origin, direction: along / length, t_max: f64::INFINITY }, length)
    }

    /// The point at this depth along a pixel's ray.
    #[must_use]
    pub fn position(&self, pixel: [u32; 2], depth: f64) -> DVec3 {
        let (ray, length) = self.ray(pixel);
        ray.origin + depth * length * ray.direction
    }

    /// A traced pixel: every pixel of `full`.
    #[must_use]
    pub fn traced(&self, pixel: [u32; 2], rounding: &mut Rounding) -> Sample {
        let (ray, length) = self.ray(pixel);
        let mut sample = self.reference.sample(&ray, &Limits::of(&self.settings), rounding);
        sample.attributes.depth /= length;
        sample
    }

    /// A pixel of an adaptive frame. `decided` says how pixels came to be, where that is not the reference's to decide:
    /// so one step is compared with a tracer's given what the tracer did in the steps before.
    #[must_use]
    pub fn adaptive(
        &self,
        pixel: [u32; 2],
        decided: Option<&dyn Fn([u32; 2]) -> Origin>,
        rounding: &mut Rounding,
    ) -> Pixel {
        let references = self
            .references(pixel)
            .map(|[a, b]| [self.reached(a, decided, rounding), self.reached(b, decided, rounding)]);
        let failed = references.map_or(0, |[a, b]| self.failed(&a, &b));
        let origin = match (decided, pixel.map(|x| x % 2)) {
            (Some(decided), _) => decided(pixel),
            (None, [0, 0]) => Origin::Base,
            (None, _) if references.is_some() && failed == 0 => Origin::Interpolated,
            (None, [_, 0]) => Origin::TracedA1,
            (None, _) => Origin::TracedA2,
        };
        match references {
            Some([a, b]) if origin == Origin::Interpolated => {
                let attributes = self.interpolated(&a.attributes, &b.attributes);
                Pixel { origin, failed, attributes, color: self.shaded(pixel, &attributes, rounding) }
            }
            _ => {
                let Sample { attributes, color } = self.traced(pixel, rounding);
                Pixel { origin, failed, attributes, color }
            }
        }
    }

    /// What is stored of a pixel of a base row.
    fn reached(
        &self,
        pixel: [u32; 2],
        decided: Option<&dyn Fn([u32; 2]) -> Origin>,
        rounding: &mut Rounding,
    ) -> Reached {
        let exact = self.adaptive(pixel, decided, rounding).attributes;
        let attributes = exact.stored(&self.reference.features, rounding);
        Reached { attributes, position: self.position(pixel, attributes.depth) }
    }

    /// The pixels that a pixel is interpolated from: left and right in the base rows (Step-II), above and below in the
    /// others (Step-III); none for base pixels and along the border of a frame of even size.
    fn references(&self, [x, y]: [u32; 2]) -> Option<[[u32; 2]; 2]> {
        let [width, height] = self.size;
        match (x % 2, y % 2) {
            (0, 0) => None,
            (_, 0) => (x + 1 < width).then(|| [[x - 1, y], [x + 1, y]]),
            _ => (y + 1 < height).then(|| [[x, y - 1], [x, y + 1]]),
        }
    }
}

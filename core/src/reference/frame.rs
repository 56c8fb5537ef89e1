//! A frame: primary rays and the methods `full`, `adaptive` and `checkerboard`. Every pixel is computed on its
//! own, with everything that it depends on.

use glam::DVec3;

use super::{
    Attributes, Limits, Ray, Reference, Rounding, Sample, postcorrection::before, similarity::Reached,
};
use crate::{Camera, Mip, Origin, Settings};

/// A frame that the reference renders in f64.
pub struct ReferenceFrame<'a> {
    /// The scene.
    pub reference: &'a Reference,
    /// The camera.
    pub camera: Camera,
    /// Width and height in pixels; in samples if pixels have several.
    pub size: [u32; 2],
    /// The settings of the frame.
    pub settings: Settings,
}

/// A pixel of an adaptive frame with the results of its checks.
#[derive(Clone, Copy, Debug)]
pub struct Pixel {
    /// The step of the method that produced the pixel.
    pub origin: Origin,
    /// The checks that fail between its two references, as their [bits](crate::Check::bit).
    pub failed: u32,
    /// Attributes of the first hit, not yet quantised for storage.
    pub attributes: Attributes,
    /// Linear RGB radiance.
    pub color: DVec3,
}

/// Scale of the width over which textures are averaged, relative to the width of a sample.
const SHARE: f64 = 0.85;

impl ReferenceFrame<'_> {
    /// The ray through a pixel's centre, and the length of its direction before normalisation, the unit of
    /// depths.
    #[must_use]
    pub fn ray(&self, pixel: [u32; 2]) -> (Ray, f64) {
        self.ray_at(pixel.map(|i| f64::from(i) + 0.5), 1.0)
    }

    /// The ray through a position in the frame, in pixels from the upper left corner, with a cone as wide as
    /// `side`.
    pub(super) fn ray_at(&self, [x, y]: [f64; 2], side: f64) -> (Ray, f64) {
        let [width, height] = self.size.map(f64::from);
        let right = (2.0 * x - width) / height * self.camera.right.as_dvec3();
        let up = (height - 2.0 * y) / height * self.camera.up.as_dvec3();
        let (eye, forward) = (self.camera.origin.as_dvec3(), self.camera.forward.as_dvec3());
        let (origin, along) = match self.camera.orthographic {
            true => (eye + right + up, forward),
            false => (eye, forward + right + up),
        };
        let length = along.length();
        // The cone's width only matters for texture averages.
        let side = match self.settings.mip {
            Mip::Off => 0.0,
            Mip::On => SHARE * 2.0 * side * self.camera.up.as_dvec3().length() / height,
        };
        let (width, growth) = if self.camera.orthographic { (side, 0.0) } else { (0.0, side / length) };
        (Ray { origin, direction: along / length, t_max: f64::INFINITY, width, growth }, length)
    }

    /// The point at this depth along a pixel's ray.
    #[must_use]
    pub fn position(&self, pixel: [u32; 2], depth: f64) -> DVec3 {
        let (ray, length) = self.ray(pixel);
        ray.origin + depth * length * ray.direction
    }

    /// Traces a pixel, as `full` does for every one.
    #[must_use]
    pub fn traced(&self, pixel: [u32; 2], rounding: &mut Rounding) -> Sample {
        let (ray, length) = self.ray(pixel);
        self.followed(&ray, length, rounding)
    }

    /// Traces a ray whose direction had this length before it was normalised.
    pub(super) fn followed(&self, ray: &Ray, length: f64, rounding: &mut Rounding) -> Sample {
        let mut sample = self.reference.sample(ray, &Limits::of(&self.settings), rounding);
        sample.attributes.depth /= length;
        sample
    }

    /// Linear radiance of a pixel of a checkerboard frame: dark squares are traced, a light one is the average of
    /// its traced neighbours.
    #[must_use]
    pub fn checkerboard(&self, [x, y]: [u32; 2], rounding: &mut Rounding) -> DVec3 {
        if (x + y).is_multiple_of(2) {
            return self.traced([x, y], rounding).color;
        }
        let around = [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)];
        let inside = around.into_iter().filter(|(x, y)| *x < self.size[0] && *y < self.size[1]);
        let colors: Vec<DVec3> = inside.map(|(x, y)| self.traced([x, y], rounding).color).collect();
        colors.iter().sum::<DVec3>() / colors.len() as f64
    }

    /// A pixel of an adaptive frame. If `decided` is given, it states how pixels were obtained; a single step can
    /// then be compared with a tracer's, given the results of its earlier steps.
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
        let step = self.step(pixel);
        let stride = step.map_or(2, |[right, down]| 2 * (right + down));
        let failed = references.map_or(0, |[a, b]| self.failed(&a, &b, stride));
        let origin = match (decided, step) {
            (Some(decided), _) => decided(pixel),
            (None, Some(_)) if references.is_some() && failed == 0 => Origin::Interpolated,
            (None, None) => Origin::Base,
            (None, Some([_, 0])) => Origin::TracedA1,
            (None, Some(_)) => Origin::TracedA2,
        };
        match references {
            Some([a, b]) if origin == Origin::Interpolated => {
                let attributes = self.interpolated(&a.attributes, &b.attributes);
                Pixel { origin, failed, attributes, color: self.shaded(pixel, &attributes, rounding) }
            }
            _ => {
                let Sample { attributes, color, .. } = self.traced(pixel, rounding);
                Pixel { origin, failed, attributes, color }
            }
        }
    }

    /// The stored attributes of a pixel in a base row; steps that refer to it run before postcorrection.
    fn reached(
        &self,
        pixel: [u32; 2],
        decided: Option<&dyn Fn([u32; 2]) -> Origin>,
        rounding: &mut Rounding,
    ) -> Reached {
        let before = decided.map(|decided| move |p| before(decided(p)));
        let decided = before.as_ref().map(|before| before as &dyn Fn([u32; 2]) -> Origin);
        let exact = self.adaptive(pixel, decided, rounding).attributes;
        let attributes = exact.stored(&self.reference.features, rounding);
        Reached { attributes, position: self.position(pixel, attributes.depth) }
    }

    /// Offset from a pixel's first reference to the pixel, right and down: along the row in Step-II, along the
    /// column in Step-III, halved at each level. `None` for base pixels.
    fn step(&self, [x, y]: [u32; 2]) -> Option<[u32; 2]> {
        let mut reach = self.settings.block / 2;
        while reach > 0 {
            let stride = 2 * reach;
            match (x % stride, y % stride) {
                (0, 0) => return None,
                (x, 0) if x == reach => return Some([reach, 0]),
                (x, y) if y == reach && x % reach == 0 => return Some([0, reach]),
                _ => reach /= 2,
            }
        }
        None
    }

    /// The two references of a pixel: left and right, or above and below. `None` for base pixels and if the
    /// second one is outside the frame.
    fn references(&self, pixel: [u32; 2]) -> Option<[[u32; 2]; 2]> {
        let step = self.step(pixel)?;
        let second = [0, 1].map(|i| pixel[i] + step[i]);
        let inside = [0, 1].iter().all(|&i| second[i] < self.size[i]);
        inside.then(|| [[0, 1].map(|i| pixel[i] - step[i]), second])
    }
}

//! Postcorrection (Kim 2016, section 4): spreads from traced pixels to interpolated neighbours that differ.

use std::collections::BTreeSet;

use glam::{DVec2, DVec3, Vec3};

use super::{Attributes, Cause, ReferenceFrame, Rounding};
use crate::{Origin, Postcorrect};

impl ReferenceFrame<'_> {
    /// The pixels that postcorrection traces, where `decided` states how pixels were obtained before: the least
    /// set with every interpolated pixel that a probe point projects onto, and every interpolated neighbour that
    /// differs from a traced pixel or from one of the set.
    #[must_use]
    pub fn postcorrection(&self, decided: &dyn Fn([u32; 2]) -> Origin) -> BTreeSet<[u32; 2]> {
        let [width, height] = self.size;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let mut open: Vec<_> = pixels.filter(|p| decided(*p) != Origin::Interpolated).collect();
        let marked = self
            .reference
            .thinness
            .probe_points()
            .iter()
            .filter_map(|point| self.pixel_at(self.place(point.as_dvec3(), &mut Rounding::none())));
        let mut found: BTreeSet<_> = marked.filter(|p| decided(*p) == Origin::Interpolated).collect();
        open.extend(&found);
        while let Some(pixel) = open.pop() {
            let seen = self.traced(pixel, &mut Rounding::none()).attributes;
            for next in self.neighbours(pixel).filter(|next| decided(*next) == Origin::Interpolated) {
                let told = self.adaptive(next, Some(decided), &mut Rounding::none()).attributes;
                if self.differ(&seen, &told) && found.insert(next) {
                    open.push(next);
                }
            }
        }
        found
    }

    /// Whether postcorrection traces a pixel, where `decided` states how it and its neighbours were finally
    /// obtained.
    #[must_use]
    pub fn postcorrects(
        &self,
        pixel: [u32; 2],
        decided: &dyn Fn([u32; 2]) -> Origin,
        rounding: &mut Rounding,
    ) -> bool {
        let before = |p| before(decided(p));
        if before(pixel) != Origin::Interpolated {
            return false;
        }
        let marked = |point: &Vec3| self.pixel_at(self.place(point.as_dvec3(), rounding)) == Some(pixel);
        if self.reference.thinness.probe_points().iter().any(marked) {
            return true;
        }
        let told = self.adaptive(pixel, Some(&before), rounding).attributes;
        self.neighbours(pixel)
            .filter(|next| decided(*next) != Origin::Interpolated)
            .any(|next| self.differ(&self.traced(next, rounding).attributes, &told))
    }

    /// Position in the image where a point is seen, in pixels from the upper left; negative behind the camera.
    pub(super) fn place(&self, point: DVec3, rounding: &mut Rounding) -> DVec2 {
        let camera = &self.camera;
        let [width, height] = self.size.map(f64::from);
        let away = point - camera.origin.as_dvec3();
        let along = |axis: Vec3| away.dot(axis.as_dvec3()) / axis.as_dvec3().length_squared();
        let depth = along(camera.forward);
        if depth <= 0.0 {
            return DVec2::NEG_ONE;
        }
        let depth = if camera.orthographic { 1.0 } else { depth };
        let middle = DVec2::new(along(camera.right), -along(camera.up)) / depth;
        rounding.pair(Cause::Storage, 0.5 * (DVec2::new(width, height) + middle * height), width.max(height))
    }

    pub(super) fn pixel_at(&self, place: DVec2) -> Option<[u32; 2]> {
        let inside = place.cmpge(DVec2::ZERO).all()
            && place.x < f64::from(self.size[0])
            && place.y < f64::from(self.size[1]);
        inside.then_some([place.x as u32, place.y as u32])
    }

    fn differ(&self, a: &Attributes, b: &Attributes) -> bool {
        let shadows = self.settings.postcorrect != Postcorrect::Objects;
        a.object != b.object || (shadows && a.shadow != b.shadow)
    }

    fn neighbours(&self, [x, y]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
        let [width, height] = self.size;
        let around = [[x.wrapping_sub(1), y], [x + 1, y], [x, y.wrapping_sub(1)], [x, y + 1]];
        around.into_iter().filter(move |[x, y]| *x < width && *y < height)
    }
}

/// How a pixel was obtained before postcorrection.
pub(super) fn before(origin: Origin) -> Origin {
    if origin == Origin::Postcorrected { Origin::Interpolated } else { origin }
}

//! Light from emissive surfaces by next-event estimation.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{Intersection, Ray, Reference, Rounding, Surface};

/// Shadow rays end this factor beyond the point on the emitter, so that rounding does not decide the hit.
const REACH: f64 = 1.001;

/// The light that arrives from a sampled point on an emitter.
#[derive(Clone, Copy)]
pub(super) struct Emitted {
    pub radiance: DVec3,
    /// Unit vector to the light.
    pub direction: DVec3,
    /// Density with which this direction is sampled, per unit of solid angle.
    pub density: f64,
}

impl Reference {
    /// The light that reaches a surface from the emitter point selected by uniform numbers in [0, 1): one selects
    /// the emitter, the others the point on it.
    pub(super) fn emitted(
        &self,
        s: &Surface,
        which: f32,
        place: [f64; 2],
        rounding: &mut Rounding,
    ) -> Option<Emitted> {
        let primitive = self.emitters.primitives[self.emitters.draw(which)] as usize;
        let (point, normal) = self.point_on(primitive, place);
        let way = point - s.position;
        let distance = way.length();
        let direction = way / distance;
        if !self.reaches(s, direction) || normal.dot(direction) == 0.0 {
            return None;
        }
        let ray = Ray { t_max: REACH * distance, ..s.spawn(direction, (0.0, 0.0), rounding) };
        let (intersection, hit, share) = self.arrived(ray, s.primitive, primitive, rounding)?;
        // From outside, a ray hits the near side of a sphere, which hides points on the far side.
        let hidden = primitive >= self.scene.positions.len() && hit.inside != (normal.dot(direction) > 0.0);
        if intersection.primitive != primitive || hidden {
            return None;
        }
        let m = self.material(hit.object, hit.texcoord, hit.footprint, hit.color, &hit.maps);
        let density = self.density(hit.object, normal.dot(direction), distance);
        Some(Emitted { radiance: share * m.emission, direction, density })
    }

    /// Share of the light from infinity that arrives along a ray: 0 behind a surface that hides what is behind it.
    pub(super) fn share_from_beyond(&self, mut ray: Ray, mut left: usize, rounding: &mut Rounding) -> f64 {
        let mut share = 1.0;
        while let Some(intersection) = self.first(&ray, Some(left), false, rounding) {
            let hit = self.surface(&ray, &intersection, rounding);
            let covered = self.coverage(hit.object, hit.texcoord, hit.footprint, hit.alpha);
            if covered >= 1.0 {
                return 0.0;
            }
            share *= 1.0 - covered;
            ray = hit.spawn(ray.direction, (hit.width, hit.growth), rounding);
            left = hit.primitive;
        }
        share
    }

    /// The first surface on the way to an emitter that hides what is behind it, or the emitter, and the share of the
    /// emitter's light that passes the surfaces before it.
    fn arrived(
        &self,
        mut ray: Ray,
        mut left: usize,
        emitter: usize,
        rounding: &mut Rounding,
    ) -> Option<(Intersection, Surface, f64)> {
        let mut share = 1.0;
        loop {
            let intersection = self.first(&ray, Some(left), false, rounding)?;
            let hit = self.surface(&ray, &intersection, rounding);
            let covered = self.coverage(hit.object, hit.texcoord, hit.footprint, hit.alpha);
            if intersection.primitive == emitter {
                return Some((intersection, hit, share * covered));
            }
            if covered >= 1.0 {
                return Some((intersection, hit, share));
            }
            share *= 1.0 - covered;
            let t_max = ray.t_max - intersection.t;
            ray = Ray { t_max, ..hit.spawn(ray.direction, (hit.width, hit.growth), rounding) };
            left = hit.primitive;
        }
    }

    /// Density of next-event estimation per unit of solid angle, for a point on an emitter seen at this cosine
    /// and distance.
    pub(super) fn density(&self, object: u32, cosine: f64, distance: f64) -> f64 {
        let strength = self.material_of(object).emission.as_dvec3().element_sum();
        strength / self.emitters.total * distance * distance / cosine.abs()
    }

    /// A point on a primitive, uniform over its area, and the unit normal there.
    fn point_on(&self, primitive: usize, [u, v]: [f64; 2]) -> (DVec3, DVec3) {
        let Some(corners) = self.scene.positions.get(primitive) else {
            let sphere = &self.scene.spheres[primitive - self.scene.positions.len()];
            let (z, phi) = (1.0 - 2.0 * u, TAU * v);
            let r = (1.0 - z * z).max(0.0).sqrt();
            let normal = DVec3::new(r * phi.cos(), r * phi.sin(), z);
            return (sphere.center.as_dvec3() + f64::from(sphere.radius) * normal, normal);
        };
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let r = u.sqrt();
        let point = (1.0 - r) * a + r * (1.0 - v) * b + r * v * c;
        (point, (b - a).cross(c - a).normalize_or_zero())
    }
}

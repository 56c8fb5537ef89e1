//! Shadow rays to every light in front of the surface (SHDBIT of Kim 2016, section 3.2).

use std::{cell::Cell, f64::consts::PI};

use glam::DVec3;

use super::{Cause, Material, Ray, Reference, Rounding, Surface, material::Shading};
use crate::scene::octahedral_decode_exact;

/// Shadow rays end at this fraction of the distance to a light, so that a light that lies in a surface is not
/// shadowed by it.
const REACH: f64 = 0.99999;

impl Reference {
    /// Share of the light that arrives along a ray, which starts on the primitive `left` if on any: 0 if it hits a
    /// surface that casts a shadow, dimmed by those that cover in part.
    #[must_use]
    pub fn unobstructed(&self, ray: &Ray, left: Option<usize>, rounding: &mut Rounding) -> f64 {
        let share = Cell::new(1.0);
        let stopped = self.first_of(ray, left, true, rounding, |intersection, rounding| {
            let blends = self.material_of(intersection.object).blends;
            let alpha = if blends { self.alpha(intersection, rounding) } else { 1.0 };
            share.set(share.get() * (1.0 - alpha.min(1.0)));
            alpha >= 1.0
        });
        if stopped.is_some() { 0.0 } else { share.get() }
    }

    /// Bit i is set if light i does not reach the surface undimmed. Lights behind the shading normal contribute
    /// nothing, and their bits are 0.
    #[must_use]
    pub fn shadow_bits(&self, s: &Surface, rounding: &mut Rounding) -> u32 {
        let lights = 0..self.scene.lights.len();
        lights.filter(|i| self.light_share(s, *i, rounding) < 1.0).fold(0, |bits, i| bits | 1 << i)
    }

    /// Share of a light that reaches the surface; 1 for a light behind the shading normal.
    pub(super) fn light_share(&self, s: &Surface, light: usize, rounding: &mut Rounding) -> f64 {
        let s = &self.lit_side(s, self.arrival(light, s.position).direction);
        let origin = s.position + rounding.spawn(Cause::ShadowEdge, s.extent) * s.face;
        let origin = rounding.vector(Cause::ShadowEdge, origin, s.extent);
        let arrival = self.arrival(light, origin);
        let direction = rounding.direction(Cause::ShadowEdge, arrival.direction);
        if s.normal.dot(direction) <= 0.0 && !self.material_of(s.object).bends_normals() {
            return 1.0;
        }
        if s.face.dot(direction) > 0.0 {
            return self.share_along(light, origin, direction, arrival.distance, Some(s.primitive), rounding);
        }
        // The face shadows itself, but not the curved surface above it.
        let lift = self.lift(s);
        if s.normal.dot(direction) <= 0.0 || lift.dot(s.face) <= rounding.spawn(Cause::ShadowEdge, s.extent) {
            return 0.0;
        }
        let up = Ray { origin, direction: lift, t_max: 1.0, width: 0.0, growth: 0.0 };
        let share = self.unobstructed(&up, Some(s.primitive), rounding);
        if share == 0.0 {
            return 0.0;
        }
        let above = self.arrival(light, origin + lift);
        share * self.share_along(light, origin + lift, above.direction, above.distance, None, rounding)
    }

    /// The surface as a light in this direction sees it: from behind where a translucent one is lit from there.
    fn lit_side(&self, s: &Surface, direction: DVec3) -> Surface {
        if s.normal.dot(direction) >= 0.0 || !self.material_of(s.object).is_translucent() {
            return *s;
        }
        Surface { normal: -s.normal, face: -s.face, inside: !s.inside, ..*s }
    }

    /// Whether light from this direction reaches the viewer by the lobes for which light is looked for.
    pub(super) fn reaches(&self, s: &Surface, direction: DVec3) -> bool {
        let [normal, face] = [s.normal, s.face].map(|n| n.dot(direction));
        normal > 0.0 && face > 0.0
            || normal < 0.0 && face < 0.0 && self.material_of(s.object).is_translucent()
    }

    /// Share of a light that arrives from a direction at a point, on the primitive `left` if on any.
    fn share_along(
        &self,
        light: usize,
        origin: DVec3,
        direction: DVec3,
        distance: f64,
        left: Option<usize>,
        rounding: &mut Rounding,
    ) -> f64 {
        let mut t_max = REACH * distance - f64::from(self.scene.lights[light].radius);
        if t_max.is_finite() {
            t_max = rounding.number(Cause::ShadowEdge, t_max, distance);
        }
        self.unobstructed(&Ray { origin, direction, t_max, width: 0.0, growth: 0.0 }, left, rounding)
    }

    /// Vector from a point of a triangle to the curved surface that the normals of its corners stand for (Hanika 2021,
    /// "Hacking the Shadow Terminator").
    fn lift(&self, s: &Surface) -> DVec3 {
        let Some(corners) = self.scene.positions.get(s.primitive) else { return DVec3::ZERO };
        let side = if s.inside { -1.0 } else { 1.0 };
        let weights = DVec3::new(1.0 - s.barycentric.x - s.barycentric.y, s.barycentric.x, s.barycentric.y);
        let planes = corners.iter().zip(self.scene.normals[s.primitive]).zip(weights.to_array());
        let lifts = planes.map(|((corner, normal), weight)| {
            let normal = side * octahedral_decode_exact(normal);
            let below = (s.position - corner.as_dvec3()).dot(normal).min(0.0);
            -weight * below * normal
        });
        lifts.sum()
    }

    /// Direct light that surfaces dim on its way, reflected to the viewer: what [`Reference::shadow_bits`] leaves
    /// out but should not.
    pub(super) fn dimmed(&self, s: &Surface, m: Material, view: DVec3, rounding: &mut Rounding) -> DVec3 {
        if m.unlit || !self.features.coverage {
            return DVec3::ZERO;
        }
        let (cosine, mut sum) = (s.normal.dot(view).clamp(0.0, 1.0), DVec3::ZERO);
        for light in 0..self.scene.lights.len() {
            let share = self.light_share(s, light, rounding);
            if share == 0.0 || share >= 1.0 {
                continue;
            }
            let mut shading = Shading {
                material: m,
                position: s.position,
                normal: s.normal,
                view,
                inside: s.inside,
                shadow: !(1 << light),
                rounding,
            };
            let behind = m.behind(cosine, s.inside) / PI * self.lights_behind(&shading);
            let behind = behind + self.coat_lit(&mut shading);
            sum += share * (behind + self.lights_reflected(&mut shading, m.diffuse(cosine, s.inside)));
        }
        sum
    }
}

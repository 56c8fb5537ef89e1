//! Shadow rays to every light in front of the surface (SHDBIT of Kim 2016, section 3.2).

use super::{Cause, Ray, Reference, Rounding, Surface};

/// Shadow rays end at this fraction of the distance to a light, so that a light that lies in a surface is not
/// shadowed by it.
const REACH: f64 = 0.99999;

impl Reference {
    /// Whether the ray, which starts on the primitive `left` if on any, hits a surface that casts shadows.
    #[must_use]
    pub fn occluded(&self, ray: &Ray, left: Option<usize>, rounding: &mut Rounding) -> bool {
        self.first(ray, left, true, rounding).is_some()
    }

    /// Bit i is set if light i does not reach the surface. Lights behind the shading normal contribute nothing,
    /// and their bits are 0.
    #[must_use]
    pub fn shadow_bits(&self, s: &Surface, rounding: &mut Rounding) -> u32 {
        let lights = 0..self.scene.lights.len();
        lights.filter(|i| self.in_shadow(s, *i, rounding)).fold(0, |bits, i| bits | 1 << i)
    }

    fn in_shadow(&self, s: &Surface, light: usize, rounding: &mut Rounding) -> bool {
        let origin = s.position + rounding.spawn(Cause::ShadowEdge, s.extent) * s.face;
        let origin = rounding.vector(Cause::ShadowEdge, origin, s.extent);
        let arrival = self.arrival(light, origin);
        let direction = rounding.direction(Cause::ShadowEdge, arrival.direction);
        if s.normal.dot(direction) <= 0.0 && !self.material_of(s.object).has_normal_map() {
            return false;
        }
        if s.face.dot(direction) <= 0.0 {
            return true;
        }
        let t_max = REACH * arrival.distance - f64::from(self.scene.lights[light].radius);
        let t_max = if t_max.is_finite() {
            rounding.number(Cause::ShadowEdge, t_max, arrival.distance)
        } else {
            t_max
        };
        self.occluded(&Ray { origin, direction, t_max, width: 0.0, growth: 0.0 }, Some(s.primitive), rounding)
    }
}

//! Point, spot and directional lights (KHR_lights_punctual).

use std::f64::consts::PI;

use glam::DVec3;

use super::{Reference, material::Shading};
use crate::scene::LightKind;

/// Least squared distance to a light.
const LEAST_DISTANCE2: f64 = 1e-30;
/// Upper bound of the irradiance of a light, as in the shaders.
const MOST_IRRADIANCE: f64 = 1e30;

/// The light that arrives at a point from one punctual light.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// Unit vector from the surface to the light.
    pub direction: DVec3,
    /// Distance to the light; infinite for directional lights.
    pub distance: f64,
    /// Irradiance of a surface that faces the unobstructed light.
    pub irradiance: DVec3,
}

impl Reference {
    /// The light that arrives at a point from light `index`.
    #[must_use]
    pub fn arrival(&self, index: usize, position: DVec3) -> Arrival {
        let light = &self.scene.lights[index];
        let intensity = light.intensity.as_dvec3();
        let (at, range, falloff, cone) = match &light.kind {
            LightKind::Directional { direction } => {
                let direction = -direction.as_dvec3().normalize();
                return Arrival { direction, distance: f64::INFINITY, irradiance: intensity };
            }
            LightKind::Point { position, range, falloff } => (position, range, *falloff, None),
            LightKind::Spot { position, range, direction, cone } => {
                (position, range, true, Some((direction.as_dvec3(), cone)))
            }
        };
        let to_light = at.as_dvec3() - position;
        let distance2 = to_light.length_squared().max(LEAST_DISTANCE2);
        let (distance, direction) = (distance2.sqrt(), to_light / distance2.sqrt());
        if !falloff {
            return Arrival { direction, distance, irradiance: intensity };
        }
        let window = (1.0 - (distance / f64::from(*range)).powi(4)).clamp(0.0, 1.0);
        // KHR_lights_punctual, "Inner and Outer Cone Angles".
        let inside = cone.map_or(1.0, |(axis, cone)| {
            let [inner, outer] = [cone.start, cone.end].map(|angle| f64::from(angle).cos());
            ((-direction.dot(axis) - outer) / (inner - outer).max(0.001)).clamp(0.0, 1.0).powi(2)
        });
        let irradiance = (intensity * (window * inside / distance2)).min(DVec3::splat(MOST_IRRADIANCE));
        Arrival { direction, distance, irradiance }
    }

    /// Irradiance of the lights behind a surface, on its back.
    pub(super) fn lights_behind(&self, s: &Shading<'_>) -> DVec3 {
        let lights = (0..self.scene.lights.len()).filter(|i| s.shadow >> i & 1 == 0);
        let arrivals = lights.map(|i| self.arrival(i, s.position));
        arrivals.map(|arrival| arrival.irradiance * (-s.normal.dot(arrival.direction)).max(0.0)).sum()
    }

    /// Radiance that a coat with a normal of its own reflects towards the viewer from the lights that are not shadowed.
    pub(super) fn coat_lit(&self, s: &mut Shading<'_>) -> DVec3 {
        let shadow = s.shadow;
        let mut sum = DVec3::ZERO;
        for i in (0..self.scene.lights.len()).filter(|i| shadow >> i & 1 == 0) {
            let arrival = self.arrival(i, s.position);
            sum += arrival.irradiance * s.coat_lobe(arrival.direction);
        }
        sum
    }

    /// Radiance that a surface reflects towards the viewer from the lights that are not shadowed.
    pub(super) fn lights_reflected(&self, s: &mut Shading<'_>, diffuse: DVec3) -> DVec3 {
        let shadow = s.shadow;
        let mut sum = DVec3::ZERO;
        for i in (0..self.scene.lights.len()).filter(|i| shadow >> i & 1 == 0) {
            let arrival = self.arrival(i, s.position);
            let cosine = s.normal.dot(arrival.direction).max(0.0);
            sum += arrival.irradiance * cosine * (diffuse / PI + s.lobe(arrival.direction));
        }
        sum
    }
}

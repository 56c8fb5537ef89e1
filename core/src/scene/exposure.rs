//! Exposure of scenes whose lights have photometric strengths.

use std::f32::consts::PI;

use glam::Vec3;

use super::{Environment, LightKind, Scene};

/// Irradiance of all lights, in units of that under which a white surface has radiance 1, from which on they count as
/// photometric: candela and lux of real lamps and skies are hundreds and more.
const PHOTOMETRIC: f32 = 10.0;

impl Scene {
    /// The exposure in EV under which a white surface in the middle of the scene that faced all of its lights would
    /// have radiance 1, if they would make it ten times as bright or more; else 0.
    #[must_use]
    pub fn auto_exposure(&self) -> f32 {
        let Some((low, high)) = self.bounds() else { return 0.0 };
        let radiance = self.lights.iter().map(|light| {
            let distance = |position: Vec3| (position - 0.5 * (low + high)).length().max(light.radius);
            let falloff = match light.kind {
                LightKind::Point { position, falloff: true, .. } | LightKind::Spot { position, .. } => {
                    distance(position).powi(-2)
                }
                LightKind::Point { .. } | LightKind::Directional { .. } => 1.0,
            };
            light.intensity.max_element() * falloff / PI
        });
        let radiance: f32 = radiance.sum();
        if (PHOTOMETRIC..f32::INFINITY).contains(&radiance) { -radiance.log2() } else { 0.0 }
    }

    /// This scene with all its light multiplied by 2 to the power of `exposure`; unlit surfaces stay as they are.
    #[must_use]
    pub fn exposed(mut self, exposure: f32) -> Self {
        let factor = exposure.exp2();
        self.lights.iter_mut().for_each(|light| light.intensity *= factor);
        self.materials.iter_mut().for_each(|material| material.emission *= factor);
        let Environment { background, ambient, fallback_radiance } = self.environment;
        self.environment = Environment {
            background: factor * background,
            ambient: factor * ambient,
            fallback_radiance: factor * fallback_radiance,
        };
        self.environment_map = self.environment_map.map(|map| map.scaled(factor));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Light, builtin};

    #[test]
    fn lights_in_lux_are_exposed_and_others_are_not() {
        let mut scene = builtin("room").expect("room");
        assert_eq!(scene.auto_exposure(), 0.0);
        let direction = Vec3::NEG_Y;
        let kind = LightKind::Directional { direction };
        scene.lights = vec![Light { kind, intensity: Vec3::splat(32_768.0 * PI), radius: 0.0 }];
        assert!((scene.auto_exposure() + 15.0).abs() < 1e-5, "{}", scene.auto_exposure());
        assert_eq!(scene.exposed(-15.0).auto_exposure(), 0.0);
    }
}

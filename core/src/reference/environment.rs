//! The environment in f64: constant radiances or a map.

use glam::{DVec3, Vec2};

use super::{Reference, Rounding, Surface, emission::Emitted};
use crate::{
    Scene,
    scene::{EnvironmentDistribution, EnvironmentMap, FIRST_FILTERED, FilteredLevel, WIDEST_LOBE, bilinear},
};

/// A map with what is derived from it; the bytes of the filtered levels and of the irradiance are the renderer's.
pub(super) struct Surroundings {
    map: EnvironmentMap,
    levels: Vec<FilteredLevel>,
    irradiance: FilteredLevel,
    distribution: EnvironmentDistribution,
}

impl Surroundings {
    pub fn of(scene: &Scene) -> Option<Self> {
        let map = scene.environment_map.clone()?;
        Some(Self {
            levels: map.filtered(),
            irradiance: map.irradiance_over_pi(),
            distribution: EnvironmentDistribution::of(&map),
            map,
        })
    }
}

impl Reference {
    /// Radiance that arrives from a direction in which there is nothing.
    pub(super) fn environment_radiance(&self, direction: DVec3) -> DVec3 {
        match &self.surroundings {
            Some(s) => s.map.radiance(direction),
            None => self.scene.environment.background.as_dvec3(),
        }
    }

    /// Radiance averaged over the lobe of a roughness around a direction.
    pub(super) fn environment_lobe(&self, direction: DVec3, roughness: f64) -> DVec3 {
        let Some(s) = &self.surroundings else { return self.environment_radiance(direction) };
        let last = s.levels.len() as f64 - 1.0;
        let finest = f64::from(FIRST_FILTERED) / f64::from(WIDEST_LOBE);
        let level = (finest * roughness * roughness).max(0.25).log2().clamp(-1.0, last);
        // Level -1 is the map itself.
        let of = |level: f64| match s.levels.get(level as usize) {
            Some(filtered) if level >= 0.0 => {
                bilinear(&filtered.texels, filtered.side, s.map.turned(direction))
            }
            _ => self.environment_radiance(direction),
        };
        of(level.floor()).lerp(of((level.floor() + 1.0).min(last)), level - level.floor())
    }

    /// Irradiance over pi of a surface with a unit normal, without what surfaces hide.
    pub(super) fn environment_ambient(&self, normal: DVec3) -> DVec3 {
        match &self.surroundings {
            Some(s) => bilinear(&s.irradiance.texels, s.irradiance.side, s.map.turned(normal)),
            None => self.scene.environment.ambient.as_dvec3(),
        }
    }

    /// Density with which directions of the map are drawn at a direction of the world, per unit of solid angle.
    pub(super) fn environment_density(&self, direction: DVec3) -> f64 {
        self.surroundings.as_ref().map_or(0.0, |s| s.distribution.density(s.map.turned(direction)))
    }

    /// The light from the direction of the map that two uniform numbers in [0, 1) select, where nothing hides it.
    pub(super) fn environment_drawn(
        &self,
        s: &Surface,
        number: Vec2,
        rounding: &mut Rounding,
    ) -> Option<Emitted> {
        let surroundings = self.surroundings.as_ref()?;
        let d = surroundings.distribution.draw(number);
        let direction = surroundings.map.turned_back(d);
        if !self.reaches(s, direction) {
            return None;
        }
        let ray = s.spawn(direction, (0.0, 0.0), rounding);
        let share = self.share_from_beyond(ray, s.primitive, rounding);
        if share == 0.0 {
            return None;
        }
        let density = surroundings.distribution.density(d);
        Some(Emitted { radiance: share * self.environment_radiance(direction), direction, density })
    }

    /// Whether the environment is a map.
    pub(super) fn has_environment_map(&self) -> bool {
        self.surroundings.is_some()
    }
}

//! Sheen of cloth (KHR_materials_sheen): the distribution of Estevez and Kulla 2017 ("Production Friendly Microfacet
//! Sheen BRDF") with the visibility of Neubelt and Pettineo 2013.

use std::{f64::consts::TAU, sync::OnceLock};

use glam::{DVec2, DVec3};

use super::Material;
use crate::scene::{ALBEDO_SIDE, LEAST_SHEEN_ROUGHNESS, LobeAlbedos};

/// A sheen at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheen {
    color: DVec3,
    roughness: f64,
    /// Albedo of a white sheen of this roughness and the factor that keeps it at most 1, by the square root of the
    /// cosine.
    shares: [DVec2; ALBEDO_SIDE],
}

impl Sheen {
    /// A sheen, unless it is black.
    pub fn of(color: DVec3, roughness: f64, albedos: &OnceLock<LobeAlbedos>) -> Option<Self> {
        (color != DVec3::ZERO).then(|| {
            let albedos = albedos.get_or_init(LobeAlbedos::new);
            let cosine = |column: usize| (column as f64 / (ALBEDO_SIDE - 1) as f64).powi(2);
            let shares = std::array::from_fn(|column| albedos.sheen(cosine(column), roughness).into());
            Self { color, roughness, shares }
        })
    }

    fn share(&self, cosine: f64) -> DVec2 {
        let place = cosine.clamp(0.0, 1.0).sqrt() * (ALBEDO_SIDE - 1) as f64;
        let low = (place as usize).min(ALBEDO_SIDE - 2);
        self.shares[low].lerp(self.shares[low + 1], place - low as f64)
    }

    fn lobe(&self, normal: DVec3, view: DVec3, light: DVec3) -> DVec3 {
        let [to_view, to_light] = [normal.dot(view).max(0.0), normal.dot(light)];
        if to_light <= 0.0 {
            return DVec3::ZERO;
        }
        let inverse = self.roughness.max(f64::from(LEAST_SHEEN_ROUGHNESS)).powi(-2);
        let sine = normal.cross((view + light).normalize_or_zero()).length().clamp(1.0e-6, 1.0);
        let distribution = (2.0 + inverse) * sine.powf(inverse) / TAU;
        let visibility = 0.25 / (to_light + to_view - to_light * to_view).max(1.0e-6);
        self.color * self.share(to_view).y * distribution * visibility
    }
}

impl Material {
    /// Share of light from all directions that the sheen reflects.
    pub(super) fn sheen_albedo(&self, cosine: f64) -> DVec3 {
        self.sheen.map_or(DVec3::ZERO, |sheen| sheen.color * sheen.share(cosine).x)
    }

    /// Share of light that the sheen leaves for what is below it.
    pub(super) fn sheen_passes(&self, cosine: f64) -> f64 {
        1.0 - self.sheen_albedo(cosine).max_element()
    }

    /// The sheen's lobe for light from a direction.
    pub(super) fn sheen_lobe(&self, normal: DVec3, view: DVec3, light: DVec3) -> DVec3 {
        self.sheen.map_or(DVec3::ZERO, |sheen| sheen.lobe(normal, view, light))
    }
}

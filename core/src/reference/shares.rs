//! What each lobe of a material has of the light, along paths.

use glam::{DMat3, DVec2, DVec3};

use super::{
    Material, Surface,
    lobes::tangents,
    microfacets::{Microfacets, Reflectance},
};
use crate::scene::{LEAST_ROUGHNESS, LobeAlbedos};

/// Albedos and lobes of a surface.
#[derive(Default)]
pub(super) struct Shares {
    pub diffuse: DVec3,
    /// On the side away from the viewer.
    pub behind: DVec3,
    pub mirror: DVec3,
    /// What a smooth coat with a normal of its own mirrors.
    pub coat_mirror: f64,
    /// Before the microfacets' reflectance, where the surface is rough.
    pub refraction: DVec3,
    /// Reflection by the rough surface, and by a rough coat over it.
    pub glossy: [Option<Microfacets>; 2],
    /// Albedo of the sheen, and what a coat lets through to it.
    pub sheen: [DVec3; 2],
}

impl Material {
    /// The shares of the lobes for a unit vector to the viewer.
    pub(super) fn shares(&self, s: &Surface, view: DVec3, albedos: &LobeAlbedos) -> Shares {
        let cosine = s.normal.dot(view).clamp(0.0, 1.0);
        if self.weights.is_some() || self.unlit {
            let [diffuse, mirror] = [self.diffuse(cosine, s.inside), self.mirror(cosine, s.inside)];
            return Shares {
                diffuse,
                mirror,
                refraction: self.refraction(cosine, s.inside),
                ..Shares::default()
            };
        }
        let mut shares = Shares::default();
        let [x, y] = tangents(s.normal);
        let frame = self.anisotropy.map_or_else(|| DMat3::from_cols(x, y, s.normal), |a| a.frame(s.normal));
        let least = f64::from(LEAST_ROUGHNESS);
        let mut under = DVec3::ONE;
        if self.coat.x > 0.0 && self.coat.y >= least {
            let strength = DVec3::splat(self.coat.x);
            let reflectance = Reflectance { f0: 0.04 * strength, f90: strength, ratio: None };
            let alpha = DVec2::splat(self.coat.y.powi(2));
            let of_coat = self.coat_normal.map_or(frame, |(normal, _)| {
                let [x, y] = tangents(normal);
                DMat3::from_cols(x, y, normal)
            });
            let coat = Microfacets::new(of_coat, view, alpha, reflectance, albedos);
            under = 1.0 - coat.albedo;
            shares.glossy[1] = Some(coat);
        } else {
            let coat = self.coat_reflectance(cosine);
            under -= coat;
            if self.coat_normal.is_some() {
                shares.coat_mirror = coat;
            } else {
                shares.mirror = DVec3::splat(coat);
            }
        }
        shares.sheen = [under * self.sheen_albedo(cosine), under];
        under *= self.sheen_passes(cosine);
        let scatters = (1.0 - self.metallic) * (1.0 - self.transmission);
        let scattered = self.base * scatters * (1.0 - self.translucency.w);
        let behind = self.translucency.truncate() * scatters * self.translucency.w;
        let entering = self.base * (1.0 - self.metallic) * self.transmission;
        if self.roughness < least && self.anisotropy.is_none() {
            let fresnel = self.fresnel(cosine, s.inside);
            shares.mirror += under * fresnel;
            let passed = 1.0 - self.dielectric(cosine, s.inside);
            [shares.diffuse, shares.behind] = [scattered, behind].map(|share| under * share * passed);
            shares.refraction = under * entering * passed;
        } else if self.roughness >= 1.0 && self.metallic == 0.0 && self.transmission == 0.0 {
            [shares.diffuse, shares.behind] = [scattered, behind].map(|share| under * share);
        } else {
            let lobe = |metallic: f64| {
                let alpha = self
                    .anisotropy
                    .map_or(DVec2::splat(self.roughness.powi(2)), |a| a.alpha(self.roughness.max(least)));
                Microfacets::new(frame, view, alpha, self.reflectance(metallic, cosine, s.inside), albedos)
            };
            let passed = under * (1.0 - lobe(0.0).albedo);
            [shares.diffuse, shares.behind] = [scattered, behind].map(|share| share * passed);
            shares.refraction = under * entering;
            shares.glossy[0] = Some(lobe(self.metallic).under(under));
        }
        shares
    }

    /// Reflectance of the microfacets at a metalness.
    fn reflectance(&self, metallic: f64, cosine: f64, inside: bool) -> Reflectance {
        let mut f0 = self.at_normal().lerp(self.base, metallic);
        let mut f90 = DVec3::splat(self.specular.w).lerp(DVec3::ONE, metallic);
        let ratio = (self.transmission > 0.0).then(|| self.ratio(inside && !self.thin));
        [f0, f90] = [f0, f90].map(|f| self.filmed(metallic, f, cosine, ratio.unwrap_or(0.0)));
        if self.thin {
            // Both faces of a pane.
            [f0, f90] = [f0, f90].map(|f| 2.0 * f / (1.0 + f));
        }
        Reflectance { f0, f90, ratio }
    }
}

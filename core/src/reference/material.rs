//! Materials by Whitted's model; the formulas are in `core/MATERIALS.md`.

use glam::{DVec2, DVec3, Vec4Swizzles};

use super::{
    Cause, Maps, Reference, Rounding,
    maps::{Place, toksvig},
};
use crate::scene::{TextureSlot, Weights};

/// Least roughness of the image of a light, which would otherwise have no width.
const LEAST_ROUGHNESS: f64 = 0.2;
/// Least cosine that the lobe's visibility term divides by.
const LEAST_COSINE: f64 = 0.05;

/// A material at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Material {
    pub(super) base: DVec3,
    pub(super) emission: DVec3,
    metallic: f64,
    roughness: f64,
    transmission: f64,
    /// Index of refraction relative to air.
    pub ior: f64,
    /// A surface without thickness: transmitted rays are not refracted.
    pub thin: bool,
    pub(super) unlit: bool,
    weights: Option<Weights>,
    occlusion: f64,
    /// Averaged normal of the normal map in the tangent frame.
    pub(super) bump: Option<DVec3>,
}

/// A material with the geometry that shading depends on.
pub(super) struct Shading<'a> {
    pub material: Material,
    pub position: DVec3,
    pub normal: DVec3,
    /// Unit vector from the surface to the viewer.
    pub view: DVec3,
    pub inside: bool,
    /// Bit i is set if light i does not reach the point.
    pub shadow: u32,
    pub rounding: &'a mut Rounding,
}

impl Reference {
    /// The material of an object at these texture coordinates and with this vertex colour, with textures averaged
    /// over a footprint; `maps` is what extended materials need besides.
    #[must_use]
    pub fn material(
        &self,
        object: u32,
        texcoord: DVec2,
        footprint: DVec3,
        color: DVec3,
        maps: &Maps,
    ) -> Material {
        let m = self.material_of(object);
        let place = Place { texcoord, footprint };
        let slot = |slot| self.slot(object, slot, place, maps);
        let base = slot(TextureSlot::BaseColor);
        let emission = slot(TextureSlot::Emissive);
        let surface = slot(TextureSlot::MetallicRoughness);
        let bump = self.bump(object, place, maps);
        let roughness = f64::from(m.roughness) * surface.y;
        let scale = DVec3::new(f64::from(m.normal_scale), f64::from(m.normal_scale), 1.0);
        Material {
            base: m.base_color.as_dvec3() * color * base.xyz(),
            emission: m.emission.as_dvec3() * emission.xyz(),
            metallic: f64::from(m.metallic) * surface.z,
            roughness: bump.map_or(roughness, |bump| toksvig(roughness, bump.length())),
            transmission: f64::from(m.transmission) * slot(TextureSlot::Transmission).x,
            ior: f64::from(m.ior),
            thin: m.thin,
            unlit: m.unlit,
            weights: m.weights,
            occlusion: 1.0 + f64::from(m.occlusion_strength) * (slot(TextureSlot::Occlusion).x - 1.0),
            bump: bump.map(|bump| bump * scale),
        }
    }

    /// Local radiance towards the viewer: emission, ambient and direct light.
    pub(super) fn local(&self, mut s: Shading<'_>) -> DVec3 {
        let m = s.material;
        if m.unlit {
            return m.base;
        }
        let cosine = s.normal.dot(s.view).clamp(0.0, 1.0);
        let (inside, ambient) = (s.inside, self.scene.environment.ambient.as_dvec3());
        m.emission
            + m.albedo(cosine, inside) * ambient * m.occlusion
            + self.lights_reflected(&mut s, m.diffuse(cosine, inside))
    }
}

impl Material {
    /// The fraction of the specular lobe that is traced as a mirror.
    fn gloss(&self) -> f64 {
        (1.0 - 2.0 * self.roughness).max(0.0)
    }

    /// Albedo of the diffuse lobe.
    fn diffuse(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(weights) => self.base * f64::from(weights.diffuse),
            None => {
                self.base
                    * (1.0 - self.metallic)
                    * (1.0 - self.transmission)
                    * (1.0 - self.fresnel(cosine, inside) * self.gloss())
            }
        }
    }

    /// Albedo for light from all directions, such as the ambient term: the diffuse lobe and the reflection of
    /// rough metal.
    #[must_use]
    pub fn albedo(&self, cosine: f64, inside: bool) -> DVec3 {
        let rough_metal = match self.weights {
            Some(_) => DVec3::ZERO,
            None => self.base * self.metallic * (1.0 - self.gloss()),
        };
        self.diffuse(cosine, inside) + rough_metal
    }

    /// The viewer's index of refraction over that of the other side.
    #[must_use]
    pub fn ratio(&self, inside: bool) -> f64 {
        if inside { self.ior } else { 1.0 / self.ior }
    }

    /// Reflectance at this cosine of the view angle.
    #[must_use]
    pub fn fresnel(&self, cosine: f64, inside: bool) -> DVec3 {
        let from_within = inside && self.transmission > 0.0 && !self.thin;
        let mut dielectric = fresnel_dielectric(cosine, self.ratio(from_within));
        if self.thin {
            // Both faces of the pane with all internal reflections.
            dielectric = 2.0 * dielectric / (1.0 + dielectric);
        }
        let metal = schlick(self.base, cosine);
        DVec3::splat(dielectric).lerp(metal, self.metallic)
    }

    /// Weight of the reflected ray's radiance.
    #[must_use]
    pub fn mirror(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(weights) => DVec3::splat(f64::from(weights.mirror)),
            None if self.unlit => DVec3::ZERO,
            None => self.fresnel(cosine, inside) * self.gloss(),
        }
    }

    /// Weight of the refracted ray's radiance, if there is one.
    #[must_use]
    pub fn refraction(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(weights) => DVec3::splat(f64::from(weights.refraction)),
            None if self.unlit => DVec3::ZERO,
            None => {
                let enters = self.transmission * (1.0 - self.metallic);
                self.base * enters * (1.0 - self.fresnel(cosine, inside))
            }
        }
    }
}

impl Shading<'_> {
    /// Microfacet lobe of the rough part of the surface for one light: Blinn-Phong distribution, Neumann's
    /// visibility term.
    pub fn lobe(&mut self, light: DVec3) -> DVec3 {
        let m = self.material;
        if m.roughness >= 1.0 || m.weights.is_some() {
            return DVec3::ZERO;
        }
        let half_way = (self.view + light).normalize_or_zero();
        let exponent = 2.0 / m.roughness.max(LEAST_ROUGHNESS).powi(4) - 2.0;
        let cosine = self.rounding.number(Cause::Highlight, self.normal.dot(half_way), 1.0).max(0.0);
        let distribution = (exponent + 2.0) / std::f64::consts::TAU * cosine.powf(exponent);
        let at_normal = ((m.ior - 1.0) / (m.ior + 1.0)).powi(2);
        let f0 = DVec3::splat(at_normal).lerp(m.base, m.metallic);
        let fresnel = schlick(f0, self.view.dot(half_way).clamp(0.0, 1.0));
        let widest = self.normal.dot(light).max(self.normal.dot(self.view)).max(LEAST_COSINE);
        fresnel * (1.0 - m.roughness) * distribution / (4.0 * widest)
    }
}

/// Schlick's approximation of reflectance from that at normal incidence.
fn schlick(f0: DVec3, cosine: f64) -> DVec3 {
    f0 + (1.0 - f0) * (1.0 - cosine).powi(5)
}

/// Fresnel's reflectance of a dielectric boundary for unpolarised light; `ratio` is the viewer's index over the other
/// side's. Beyond the critical angle it is 1.
#[must_use]
pub fn fresnel_dielectric(cosine: f64, ratio: f64) -> f64 {
    // Snell's law: squared cosine of the angle of refraction.
    let other2 = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if other2 <= 0.0 {
        return 1.0;
    }
    let other = other2.sqrt();
    let s = (ratio * cosine - other) / (ratio * cosine + other);
    let p = (cosine - ratio * other) / (cosine + ratio * other);
    0.5 * (s * s + p * p)
}

//! Materials by Whitted's model; the formulas are in `core/MATERIALS.md`.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use super::{
    Cause, Maps, Reference, Rounding,
    anisotropy::Anisotropy,
    iridescence::Film,
    maps::{Place, toksvig},
    sheen::Sheen,
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
    pub(super) metallic: f64,
    pub(super) roughness: f64,
    pub(super) transmission: f64,
    /// Index of refraction relative to air.
    pub ior: f64,
    /// A surface without thickness: transmitted rays are not refracted.
    pub thin: bool,
    pub(super) unlit: bool,
    pub(super) weights: Option<Weights>,
    occlusion: f64,
    /// Averaged normal of the normal map in the tangent frame.
    pub(super) bump: Option<DVec3>,
    /// Colour and strength of the dielectric reflection.
    pub(super) specular: DVec4,
    /// Strength and roughness of the clear coat.
    pub(super) coat: DVec2,
    /// Averaged normal of the coat's normal map in the tangent frame.
    coat_bump: Option<DVec3>,
    /// The coat's normal, and the cosine of the view to it, where it may differ from the surface's.
    pub(super) coat_normal: Option<(DVec3, f64)>,
    pub(super) sheen: Option<Sheen>,
    pub(super) anisotropy: Option<Anisotropy>,
    pub(super) film: Option<Film>,
    /// Colour of diffuse transmission and its share of the diffuse light.
    pub(super) translucency: DVec4,
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
        let mut base = m.base_color.as_dvec3() * color * base.xyz();
        let mut metallic = f64::from(m.metallic) * surface.z;
        let mut roughness = f64::from(m.roughness) * surface.y;
        let mut specular = DVec4::ONE;
        if let Some(s) = m.specular_glossiness {
            let texel = slot(TextureSlot::SpecularGlossiness);
            (base, metallic) = metallic_of(base, s.specular.as_dvec3() * texel.xyz());
            roughness = 1.0 - f64::from(s.glossiness) * texel.w;
        } else {
            let color = m.specular_color.as_dvec3() * slot(TextureSlot::SpecularColor).xyz();
            specular = color.extend(f64::from(m.specular) * slot(TextureSlot::Specular).w);
        }
        let coat = DVec2::new(
            f64::from(m.clearcoat) * slot(TextureSlot::Clearcoat).x,
            f64::from(m.clearcoat_roughness) * slot(TextureSlot::ClearcoatRoughness).y,
        );
        let coat_bump = m
            .texture(TextureSlot::ClearcoatNormal)
            .map(|_| 2.0 * slot(TextureSlot::ClearcoatNormal).xyz() - 1.0);
        let coat = DVec2::new(coat.x, coat_bump.map_or(coat.y, |bump| toksvig(coat.y, bump.length())));
        let coat_scale = f64::from(m.clearcoat_normal_scale);
        let scale = DVec3::new(f64::from(m.normal_scale), f64::from(m.normal_scale), 1.0);
        Material {
            base,
            emission: m.emission.as_dvec3() * emission.xyz(),
            metallic,
            roughness: bump.map_or(roughness, |bump| toksvig(roughness, bump.length())),
            transmission: f64::from(m.transmission) * slot(TextureSlot::Transmission).x,
            ior: f64::from(m.ior),
            thin: m.thin,
            unlit: m.unlit,
            weights: m.weights,
            occlusion: 1.0 + f64::from(m.occlusion_strength) * (slot(TextureSlot::Occlusion).x - 1.0),
            bump: bump.map(|bump| bump * scale),
            specular,
            coat,
            coat_bump: coat_bump.map(|bump| bump * DVec3::new(coat_scale, coat_scale, 1.0)),
            coat_normal: None,
            sheen: Sheen::of(
                m.sheen_color.as_dvec3() * slot(TextureSlot::SheenColor).xyz(),
                f64::from(m.sheen_roughness) * slot(TextureSlot::SheenRoughness).w,
                &self.albedos,
            ),
            anisotropy: Anisotropy::of(
                m,
                m.texture(TextureSlot::Anisotropy).map(|_| slot(TextureSlot::Anisotropy)),
                maps,
            ),
            film: Some(Film {
                strength: f64::from(m.iridescence) * slot(TextureSlot::Iridescence).x,
                ior: f64::from(m.iridescence_ior),
                thickness: {
                    let [thin, thick] = m.iridescence_thickness.map(f64::from);
                    thin + (thick - thin) * slot(TextureSlot::IridescenceThickness).y
                },
            })
            .filter(|film| film.strength > 0.0),
            translucency: {
                let color = m.diffuse_transmission_color.as_dvec3();
                let color = color * slot(TextureSlot::DiffuseTransmissionColor).xyz();
                let share = slot(TextureSlot::DiffuseTransmission).w;
                color.extend(f64::from(m.diffuse_transmission) * share)
            },
        }
    }

    /// Local radiance towards the viewer: emission, ambient and direct light.
    pub(super) fn local(&self, mut s: Shading<'_>) -> DVec3 {
        let m = s.material;
        if m.unlit {
            return m.base;
        }
        let cosine = s.normal.dot(s.view).clamp(0.0, 1.0);
        let diffuse = m.diffuse(cosine, s.inside);
        let behind = m.behind(cosine, s.inside);
        let mut from_behind = self.environment_ambient(-s.normal) * m.occlusion;
        if self.has_environment_map() {
            let [f0, f90] = [m.at_normal(), m.at_grazing()].map(|f| m.filmed(0.0, f, cosine, 0.0));
            from_behind *= 1.0 - m.rough_reflectance(f0, f90, cosine) * (1.0 - m.gloss());
        }
        m.emission
            + self.coat_lit(&mut s)
            + behind * (from_behind + self.lights_behind(&s) / PI)
            + self.environment_reflected(&m, diffuse, s.normal, s.view) * m.occlusion
            + self.lights_reflected(&mut s, diffuse + m.lit_metal(cosine) * m.sheen_passes(cosine))
    }

    /// Reflected radiance of the environment: the diffuse lobe and, of a map, the part of the specular lobe that is not
    /// traced as a mirror.
    fn environment_reflected(&self, m: &Material, diffuse: DVec3, normal: DVec3, view: DVec3) -> DVec3 {
        let ambient = self.environment_ambient(normal);
        if !self.has_environment_map() {
            let cosine = normal.dot(view).clamp(0.0, 1.0);
            let sheen = m.coat_passes(cosine) * m.sheen_albedo(cosine);
            return ambient * (diffuse + m.rough_metal(cosine) * m.sheen_passes(cosine) + sheen);
        }
        if m.weights.is_some() {
            return diffuse * ambient;
        }
        let cosine = normal.dot(view).clamp(0.0, 1.0);
        let rough = 1.0 - m.gloss();
        let filmed = |metallic, [f0, f90]: [DVec3; 2]| {
            let [f0, f90] = [f0, f90].map(|f| m.filmed(metallic, f, cosine, 0.0));
            m.rough_reflectance(f0, f90, cosine) * rough
        };
        let dielectric = filmed(0.0, [m.at_normal(), m.at_grazing()]);
        let metal = filmed(1.0, [m.base, DVec3::ONE]) * m.metallic;
        let bent = m.reflecting(normal, view);
        let mirrored = 2.0 * bent.dot(view).clamp(0.0, 1.0) * bent - view;
        let dominant = mirrored.lerp(bent, m.roughness * m.roughness);
        let lobe = self.environment_lobe(dominant, m.roughness);
        let matte = diffuse * ambient;
        let sheen = m.coat_passes(cosine) * m.sheen_albedo(cosine) * ambient;
        let seen = m.sheen_passes(cosine) * lobe;
        matte + metal * seen + dielectric * ((1.0 - m.metallic) * seen - matte) + sheen
    }
}

impl Material {
    /// The fraction of the specular lobe that is traced as a mirror.
    pub(super) fn gloss(&self) -> f64 {
        (1.0 - 2.0 * self.widest()).max(0.0)
    }

    /// Albedo of the diffuse lobe.
    pub(super) fn diffuse(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(weights) => self.base * f64::from(weights.diffuse),
            None => self.scattered((1.0 - self.translucency.w) * self.base, cosine, inside),
        }
    }

    /// Albedo of the diffuse lobe on the other side of the surface.
    pub(super) fn behind(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(_) => DVec3::ZERO,
            None => self.scattered(self.translucency.w * self.translucency.xyz(), cosine, inside),
        }
    }

    /// Albedo of a diffuse lobe of this colour under the layers and the specular lobe.
    fn scattered(&self, color: DVec3, cosine: f64, inside: bool) -> DVec3 {
        self.under(cosine)
            * color
            * (1.0 - self.metallic)
            * (1.0 - self.transmission)
            * (1.0 - self.dielectric(cosine, inside) * self.gloss())
    }

    /// Albedo for light from all directions, such as the ambient term: the diffuse lobe and the reflection of
    /// rough metal.
    #[must_use]
    pub fn albedo(&self, cosine: f64, inside: bool) -> DVec3 {
        self.diffuse(cosine, inside) + self.rough_metal(cosine)
    }

    /// The part of a metal's reflection that is not traced as a mirror.
    fn rough_metal(&self, cosine: f64) -> DVec3 {
        match self.weights {
            Some(_) => DVec3::ZERO,
            None => self.filmed(1.0, self.base, cosine, 0.0) * self.metallic * (1.0 - self.gloss()),
        }
    }

    /// The part of a metal's reflection of lights that is not in its lobe.
    fn lit_metal(&self, cosine: f64) -> DVec3 {
        match self.weights {
            Some(_) => DVec3::ZERO,
            None => self.filmed(1.0, self.base, cosine, 0.0) * self.metallic * self.roughness,
        }
    }

    /// Reflectance of the microfacets for light from all directions, from those of one at normal and at grazing
    /// incidence: single scattering (Karis 2014, "Physically Based Shading on Mobile") and what is scattered several
    /// times (Fdez-Aguera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting").
    fn rough_reflectance(&self, f0: DVec3, f90: DVec3, cosine: f64) -> DVec3 {
        let r = self.roughness;
        let r = [1.0 - r, 0.0425 - 0.0275 * r, 1.04 - 0.572 * r, 0.022 * r - 0.04];
        let a = (r[0] * r[0]).min((-9.28 * cosine).exp2()) * r[0] + r[1];
        let single = (f0 * (r[2] - 1.04 * a) + f90 * (r[3] + 1.04 * a)).max(DVec3::ZERO);
        let average = f0 + (f90 - f0) / 21.0;
        let missing = 1.0 - r[2] - r[3];
        (single + missing * single * average / (1.0 - missing * average)).min(DVec3::ONE)
    }

    /// The viewer's index of refraction over that of the other side.
    #[must_use]
    pub fn ratio(&self, inside: bool) -> f64 {
        if inside { self.ior } else { 1.0 / self.ior }
    }

    /// Reflectance of the dielectric part at this cosine of the view angle.
    pub(super) fn dielectric(&self, cosine: f64, inside: bool) -> DVec3 {
        let from_within = inside && self.transmission > 0.0 && !self.thin;
        let ratio = self.ratio(from_within);
        let mut dielectric = self.filmed(0.0, self.colored(fresnel_dielectric(cosine, ratio)), cosine, ratio);
        if self.thin {
            // Both faces of the pane with all internal reflections.
            dielectric = 2.0 * dielectric / (1.0 + dielectric);
        }
        dielectric
    }

    /// Reflectance at this cosine of the view angle.
    #[must_use]
    pub fn fresnel(&self, cosine: f64, inside: bool) -> DVec3 {
        let metal = self.filmed(1.0, schlick(self.base, cosine), cosine, 0.0);
        self.dielectric(cosine, inside).lerp(metal, self.metallic)
    }

    /// Reflectance of the dielectric part at normal incidence.
    pub(super) fn at_normal(&self) -> DVec3 {
        let plain = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2);
        (plain * self.specular.truncate()).min(DVec3::ONE) * self.specular.w
    }

    /// Reflectance at grazing incidence.
    fn at_grazing(&self) -> DVec3 {
        DVec3::splat(self.specular.w).lerp(DVec3::ONE, self.metallic)
    }

    /// Reflectance of the dielectric part, from that of Fresnel's equations.
    fn colored(&self, dielectric: f64) -> DVec3 {
        let plain = ((self.ior - 1.0) / (self.ior + 1.0)).powi(2);
        if self.specular == DVec4::ONE {
            return DVec3::splat(dielectric);
        }
        let grazing = ((dielectric - plain) / (1.0 - plain)).clamp(0.0, 1.0);
        self.at_normal().lerp(DVec3::splat(self.specular.w), grazing)
    }

    /// Reflectance of the clear coat.
    pub(super) fn coat_reflectance(&self, cosine: f64) -> f64 {
        let cosine = self.coat_normal.map_or(cosine, |(_, cosine)| cosine);
        self.coat.x * fresnel_dielectric(cosine, 1.0 / 1.5)
    }

    /// Fraction of light that passes the clear coat.
    pub(super) fn coat_passes(&self, cosine: f64) -> f64 {
        1.0 - self.coat_reflectance(cosine)
    }

    /// Fraction of light that passes the clear coat and the sheen.
    fn under(&self, cosine: f64) -> f64 {
        self.coat_passes(cosine) * self.sheen_passes(cosine)
    }

    /// The coat's part of the reflected ray's weight.
    fn coat_mirror(&self, cosine: f64) -> f64 {
        self.coat_reflectance(cosine) * (1.0 - 2.0 * self.coat.y).max(0.0)
    }

    /// The material as it is seen at a surface: with the normal of its coat, from that of the vertices.
    pub(super) fn oriented(self, apart: bool, normal: DVec3, face: DVec3, view: DVec3, maps: &Maps) -> Self {
        let coat = self.bent(self.coat_bump, self.coat.y < 0.5, normal, face, view, maps);
        let seen = (coat, coat.dot(view).clamp(0.0, 1.0));
        Self { coat_normal: apart.then_some(seen), ..self }
    }

    /// Normal of the one mirrored ray of Whitted's methods: that of the layer that mirrors more.
    pub(super) fn mirroring(&self, normal: DVec3, cosine: f64, inside: bool) -> DVec3 {
        let coat = self.coat_mirror(cosine);
        match self.coat_normal {
            Some((own, _)) if coat > (self.mirror(cosine, inside) - coat).max_element() => own,
            _ => normal,
        }
    }

    /// Weight of the reflected ray's radiance.
    #[must_use]
    pub fn mirror(&self, cosine: f64, inside: bool) -> DVec3 {
        match self.weights {
            Some(weights) => DVec3::splat(f64::from(weights.mirror)),
            None if self.unlit => DVec3::ZERO,
            None => {
                self.coat_mirror(cosine) + self.under(cosine) * self.fresnel(cosine, inside) * self.gloss()
            }
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
                self.under(cosine) * self.base * enters * (1.0 - self.dielectric(cosine, inside))
            }
        }
    }
}

impl Shading<'_> {
    /// Microfacet lobe of the rough part of the surface for one light: Blinn-Phong distribution, Neumann's
    /// visibility term.
    pub fn lobe(&mut self, light: DVec3) -> DVec3 {
        let m = self.material;
        let strength = DVec3::splat(m.coat.x);
        let cosine = self.normal.dot(self.view).clamp(0.0, 1.0);
        let sheen = m.coat_passes(cosine) * m.sheen_lobe(self.normal, self.view, light);
        let mut coat = sheen;
        if m.coat_normal.is_none() {
            coat += self.microfacets(self.normal, [0.04 * strength, strength], m.coat.y, None, light);
        }
        if m.roughness >= 1.0 || m.weights.is_some() {
            return coat;
        }
        let plain = [m.at_normal().lerp(m.base, m.metallic), m.at_grazing()];
        let reflectance = plain.map(|f| m.filmed(m.metallic, f, cosine, 0.0));
        let under = m.under(cosine);
        coat + under * self.microfacets(self.normal, reflectance, m.roughness, m.anisotropy, light)
    }

    /// The lobe of a coat with a normal of its own for one light, times the cosine.
    pub fn coat_lobe(&mut self, light: DVec3) -> DVec3 {
        let m = self.material;
        let Some((normal, _)) = m.coat_normal.filter(|(normal, _)| normal.dot(light) > 0.0) else {
            return DVec3::ZERO;
        };
        let strength = DVec3::splat(m.coat.x);
        normal.dot(light) * self.microfacets(normal, [0.04 * strength, strength], m.coat.y, None, light)
    }

    /// A microfacet lobe around a normal with its reflectance at normal and at grazing incidence.
    fn microfacets(
        &mut self,
        normal: DVec3,
        [f0, f90]: [DVec3; 2],
        roughness: f64,
        anisotropy: Option<Anisotropy>,
        light: DVec3,
    ) -> DVec3 {
        if f0 == DVec3::ZERO && f90 == DVec3::ZERO {
            return DVec3::ZERO;
        }
        let half_way = (self.view + light).normalize_or_zero();
        let least = roughness.max(LEAST_ROUGHNESS);
        let (exponent, scale) = match anisotropy {
            None => {
                let exponent = 2.0 / least.powi(4) - 2.0;
                (exponent, exponent + 2.0)
            }
            Some(a) => {
                // Between the exponents of both sides, by the direction of the half vector.
                let exponents = 2.0 / a.alpha(least).powf(2.0) - 2.0;
                let beside = (a.frame(normal).transpose() * half_way).truncate();
                let shares = (beside * beside) / beside.length_squared().max(1.0e-12);
                (shares.dot(exponents), (exponents + 2.0).element_product().sqrt())
            }
        };
        let cosine = self.rounding.number(Cause::Highlight, normal.dot(half_way), 1.0).max(0.0);
        let distribution = scale / std::f64::consts::TAU * cosine.powf(exponent);
        let fresnel = f0 + (f90 - f0) * (1.0 - self.view.dot(half_way).clamp(0.0, 1.0)).powi(5);
        let widest = normal.dot(light).max(normal.dot(self.view)).max(LEAST_COSINE);
        fresnel * (1.0 - roughness) * distribution / (4.0 * widest)
    }
}

/// Base colour and metalness of a diffuse colour and a specular reflectance (KHR_materials_pbrSpecularGlossiness,
/// appendix).
fn metallic_of(diffuse: DVec3, specular: DVec3) -> (DVec3, f64) {
    const DIELECTRIC: f64 = 0.04;
    let brightness = |c: DVec3| (c * c).dot(DVec3::new(0.299, 0.587, 0.114)).sqrt();
    let rest = 1.0 - specular.max_element();
    let metallic = if brightness(specular) < DIELECTRIC {
        0.0
    } else {
        let b = brightness(diffuse) * rest / (1.0 - DIELECTRIC) + brightness(specular) - 2.0 * DIELECTRIC;
        let c = DIELECTRIC - brightness(specular);
        let root = (b * b - 4.0 * DIELECTRIC * c).max(0.0).sqrt();
        ((root - b) / (2.0 * DIELECTRIC)).clamp(0.0, 1.0)
    };
    let from_diffuse = diffuse * rest / (1.0 - DIELECTRIC) / (1.0 - metallic).max(1.0e-6);
    let from_specular = (specular - DIELECTRIC * (1.0 - metallic)) / metallic.max(1.0e-6);
    let base = from_diffuse.lerp(from_specular, metallic * metallic);
    (base.clamp(DVec3::ZERO, DVec3::ONE), metallic)
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

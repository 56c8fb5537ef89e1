//! Materials by how a surface emits, scatters, reflects and transmits light (Whitted 1980). The formulas, and the
//! mapping of glTF's materials, are in `core/MATERIALS.md`.

use std::collections::BTreeMap;

use glam::Vec3;

use super::{SlotCoordinates, TextureSlot};

/// Roughness below which paths take a surface as a mirror.
pub const LEAST_ROUGHNESS: f32 = 0.04;

/// Difference between the indices of refraction of successive channels, as a share of the dispersion times the index less
/// 1: an Abbe number spans from red to blue (KHR_materials_dispersion).
pub const DISPERSION_STEP: f32 = 0.025;

/// How a surface reflects, transmits and emits light.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The material's name in the file, for messages.
    pub name: String,
    /// Base colour in linear RGB, multiplied by the texture and the vertex colours.
    pub base_color: Vec3,
    /// Metalness: 0 for dielectrics, 1 for metals.
    pub metallic: f32,
    /// glTF roughness (alpha = roughness^2).
    pub roughness: f32,
    /// Emitted radiance in linear RGB.
    pub emission: Vec3,
    /// Fraction of the light entering the surface that is transmitted instead of scattered diffusely.
    pub transmission: f32,
    /// Index of refraction relative to air, at least 1.
    pub ior: f32,
    /// A surface without thickness: light passes through without refraction.
    pub thin: bool,
    /// Shows the base colour without lighting (KHR_materials_unlit).
    pub unlit: bool,
    /// Alpha cutoff: surface points with lower alpha are holes; `None` for opaque materials.
    pub alpha_cutoff: Option<f32>,
    /// Whether alpha is the share that the surface covers of what is behind it (glTF's BLEND); excludes a cutoff.
    pub blends: bool,
    /// Alpha factor, multiplied by the texture's and the vertices' alpha; read with a cutoff or where the surface
    /// blends.
    pub alpha: f32,
    /// Whether the surface is seen from both sides. Rays from behind, except shadow rays, pass through a surface
    /// that is not, unless it transmits light; behind is where the corners of a triangle run clockwise. Analytic
    /// spheres always have both sides.
    pub double_sided: bool,
    /// Whether shadow rays stop at the surface; false for transmissive materials after import.
    pub casts_shadow: bool,
    /// Index of the base colour's texture: sRGB colour and linear alpha.
    pub base_color_texture: Option<u32>,
    /// Index of the metallic-roughness texture: green is roughness, blue is metalness.
    pub metallic_roughness_texture: Option<u32>,
    /// Index of the emissive texture, sRGB.
    pub emissive_texture: Option<u32>,
    /// Indices of the textures of all other slots.
    pub maps: BTreeMap<TextureSlot, u32>,
    /// Slots that do not read [`super::Scene::texcoords`] as they are.
    pub coordinates: BTreeMap<TextureSlot, SlotCoordinates>,
    /// Factor on the first two components of the normals in the normal map.
    pub normal_scale: f32,
    /// Fraction of the occlusion texture's effect.
    pub occlusion_strength: f32,
    /// Strength of the dielectric reflection, from 0 to 1 (KHR_materials_specular).
    pub specular: f32,
    /// Factor on the dielectric reflectance at normal incidence, linear RGB.
    pub specular_color: Vec3,
    /// Specular reflectance and glossiness, which determine metalness, roughness and base colour, the base colour
    /// being the diffuse one (KHR_materials_pbrSpecularGlossiness).
    pub specular_glossiness: Option<SpecularGlossiness>,
    /// Strength of a clear coat of index 1.5 over the surface, from 0 to 1 (KHR_materials_clearcoat).
    pub clearcoat: f32,
    /// Roughness of the clear coat.
    pub clearcoat_roughness: f32,
    /// Factor on the first two components of the normals in the clear coat's normal map.
    pub clearcoat_normal_scale: f32,
    /// Colour of the sheen of a cloth, linear RGB; black without sheen (KHR_materials_sheen).
    pub sheen_color: Vec3,
    /// Roughness of the sheen.
    pub sheen_roughness: f32,
    /// Strength of the anisotropy of the surface's microfacets, from 0 to 1 (KHR_materials_anisotropy).
    pub anisotropy: f32,
    /// Angle of the wider side of the lobe from the tangent towards the bitangent, in radians.
    pub anisotropy_rotation: f32,
    /// Share of the surface that a thin film covers, from 0 to 1 (KHR_materials_iridescence).
    pub iridescence: f32,
    /// Index of refraction of the film, at least 1.
    pub iridescence_ior: f32,
    /// Thickness of the film in nanometres where its texture is 0, and where it is 1 or there is none.
    pub iridescence_thickness: [f32; 2],
    /// Share of the diffuse light that is transmitted, from 0 to 1 (KHR_materials_diffuse_transmission).
    pub diffuse_transmission: f32,
    /// Colour of the light that is transmitted diffusely, linear RGB.
    pub diffuse_transmission_color: Vec3,
    /// Dispersion of a solid: 20 over its Abbe number; 0 without (KHR_materials_dispersion).
    pub dispersion: f32,
    /// Absorption coefficient of what the surface bounds, linear RGB: transmittance over a distance d is exp(-d times
    /// this).
    pub absorption: Vec3,
    /// Of two solids that take up the same space, the one of the higher priority fills it; of the same priority, the one
    /// that the ray enters later.
    pub priority: i8,
    /// Explicit weights in place of Fresnel's equations (Heckbert's minray).
    pub weights: Option<Weights>,
}

/// Factors of a specular-glossiness material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularGlossiness {
    /// Specular reflectance at normal incidence, linear RGB.
    pub specular: Vec3,
    /// One minus roughness.
    pub glossiness: f32,
}

/// Constant weights of local, reflected and transmitted light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    /// Weight of the diffuse lobe, times the base colour.
    pub diffuse: f32,
    /// Weight of the reflected ray's radiance, untinted.
    pub mirror: f32,
    /// Weight of the refracted ray's radiance, untinted; lost on total internal reflection.
    pub refraction: f32,
}

impl Default for Material {
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec3::ONE,
            metallic: 0.0,
            roughness: 1.0,
            emission: Vec3::ZERO,
            transmission: 0.0,
            ior: 1.5,
            thin: false,
            unlit: false,
            alpha_cutoff: None,
            blends: false,
            alpha: 1.0,
            double_sided: true,
            casts_shadow: true,
            base_color_texture: None,
            metallic_roughness_texture: None,
            emissive_texture: None,
            maps: BTreeMap::new(),
            coordinates: BTreeMap::new(),
            normal_scale: 1.0,
            occlusion_strength: 1.0,
            specular: 1.0,
            specular_color: Vec3::ONE,
            specular_glossiness: None,
            clearcoat: 0.0,
            clearcoat_roughness: 0.0,
            clearcoat_normal_scale: 1.0,
            sheen_color: Vec3::ZERO,
            sheen_roughness: 0.0,
            anisotropy: 0.0,
            anisotropy_rotation: 0.0,
            iridescence: 0.0,
            iridescence_ior: 1.3,
            iridescence_thickness: [100.0, 400.0],
            diffuse_transmission: 0.0,
            diffuse_transmission_color: Vec3::ONE,
            dispersion: 0.0,
            absorption: Vec3::ZERO,
            priority: 0,
            weights: None,
        }
    }
}

impl Material {
    /// Index of a slot's texture.
    #[must_use]
    pub fn texture(&self, slot: TextureSlot) -> Option<u32> {
        match slot {
            TextureSlot::BaseColor => self.base_color_texture,
            TextureSlot::MetallicRoughness => self.metallic_roughness_texture,
            TextureSlot::Emissive => self.emissive_texture,
            other => self.maps.get(&other).copied(),
        }
    }

    /// Indices of the textures that the material reads, in the order of the slots.
    pub fn textures(&self) -> impl Iterator<Item = u32> {
        TextureSlot::ALL.into_iter().filter_map(|slot| self.texture(slot))
    }

    /// Whether the material has a normal map.
    #[must_use]
    pub fn has_normal_map(&self) -> bool {
        self.maps.contains_key(&TextureSlot::Normal)
    }

    /// Whether the microfacets of the surface are anisotropic.
    #[must_use]
    pub fn is_anisotropic(&self) -> bool {
        self.anisotropy > 0.0
    }

    /// Whether normals differ from those of the vertices: by a normal map of the surface or of its clear coat.
    #[must_use]
    pub fn bends_normals(&self) -> bool {
        self.has_normal_map() || self.maps.contains_key(&TextureSlot::ClearcoatNormal)
    }

    /// Whether the clear coat may have other normals than what it covers.
    #[must_use]
    pub fn has_coat_normals(&self) -> bool {
        self.clearcoat > 0.0 && self.bends_normals()
    }

    /// Whether the material reads tangents: it has a normal map or is anisotropic.
    #[must_use]
    pub fn reads_tangents(&self) -> bool {
        self.bends_normals() || self.is_anisotropic()
    }

    /// Whether a thin film covers the surface.
    #[must_use]
    pub fn is_iridescent(&self) -> bool {
        self.iridescence > 0.0
    }

    /// Whether the surface transmits light diffusely.
    #[must_use]
    pub fn is_translucent(&self) -> bool {
        self.diffuse_transmission > 0.0
    }

    /// Whether the material bounds a solid that refracts colours apart.
    #[must_use]
    pub fn is_dispersive(&self) -> bool {
        self.dispersion > 0.0 && self.is_solid()
    }

    /// Whether the material has more than its factors and the first three textures with common coordinates.
    #[must_use]
    pub fn is_extended(&self) -> bool {
        !self.maps.is_empty()
            || !self.coordinates.is_empty()
            || self.is_layered()
            || self.is_anisotropic()
            || self.is_iridescent()
            || self.is_translucent()
            || self.is_dispersive()
    }

    /// Whether the material has a specular colour, specular-glossiness factors, a clear coat, sheen or absorption.
    #[must_use]
    pub fn is_layered(&self) -> bool {
        self.specular != 1.0
            || self.specular_color != Vec3::ONE
            || self.specular_glossiness.is_some()
            || self.clearcoat > 0.0
            || self.has_sheen()
            || self.absorption != Vec3::ZERO
            || self.maps.contains_key(&TextureSlot::Specular)
            || self.maps.contains_key(&TextureSlot::SpecularColor)
    }

    /// Whether the material has a sheen.
    #[must_use]
    pub fn has_sheen(&self) -> bool {
        self.sheen_color != Vec3::ZERO
    }

    /// Whether the material is determined by its base colour: a rough dielectric of index 1.5 that neither emits nor
    /// transmits light.
    #[must_use]
    pub fn is_matte(&self) -> bool {
        self.metallic == 0.0
            && self.roughness >= 1.0
            && self.ior == Self::default().ior
            && self.emission == Vec3::ZERO
            && self.transmission == 0.0
            && self.weights.is_none()
            && self.metallic_roughness_texture.is_none()
            && !self.is_layered()
            && !self.is_iridescent()
            && !self.is_translucent()
    }

    /// Whether paths leave some point of the surface by a microfacet lobe: rough metal, a rough dielectric that is
    /// neither matte nor a mirror, rough glass, a rough coat, sheen, or diffuse transmission, which the same kernels sample.
    #[must_use]
    pub fn has_microfacets(&self) -> bool {
        let textured = self.metallic_roughness_texture.is_some() || self.specular_glossiness.is_some();
        let rough =
            self.roughness >= LEAST_ROUGHNESS || textured || self.has_normal_map() || self.is_anisotropic();
        let diffuse = self.roughness >= 1.0 && self.metallic == 0.0 && self.transmission == 0.0 && !textured;
        let coat =
            self.clearcoat > 0.0 && (self.clearcoat_roughness >= LEAST_ROUGHNESS || self.bends_normals());
        !self.unlit
            && self.weights.is_none()
            && (rough && !diffuse || coat || self.has_sheen() || self.is_translucent())
    }

    /// Whether some view angle makes a reflection ray worth tracing.
    #[must_use]
    pub fn reflects(&self) -> bool {
        match self.weights {
            Some(weights) => weights.mirror > 0.0,
            None => {
                let coat = self.clearcoat > 0.0 && self.clearcoat_roughness < 0.5
                    || self.maps.contains_key(&TextureSlot::ClearcoatRoughness);
                let glossy = self.specular_glossiness.is_some_and(|s| s.glossiness > 0.5);
                !self.unlit
                    && (self.roughness < 0.5 || self.metallic_roughness_texture.is_some() || coat || glossy)
            }
        }
    }

    /// Whether rays from behind pass through the surface: those that transmit light need their backs, by which light
    /// leaves a solid.
    #[must_use]
    pub fn is_single_sided(&self) -> bool {
        !self.double_sided && !self.refracts() && !self.is_translucent()
    }

    /// Whether the material transmits light.
    #[must_use]
    pub fn refracts(&self) -> bool {
        match self.weights {
            Some(weights) => weights.refraction > 0.0,
            None => !self.unlit && self.transmission > 0.0,
        }
    }

    /// Whether the surface bounds a solid that transmits light.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        !self.thin && self.refracts()
    }

    /// Whether the surface of a solid shows only by refraction and reflection: the solid transmits all other light
    /// without a tint.
    #[must_use]
    pub fn is_clear(&self) -> bool {
        self.is_solid()
            && self.transmission == 1.0
            && self.metallic == 0.0
            && self.base_color == Vec3::ONE
            && self.emission == Vec3::ZERO
            && self.clearcoat == 0.0
            && self.absorption == Vec3::ZERO
            && !self.blends
            && self.weights.is_none()
            && self.textures().next().is_none()
    }
}

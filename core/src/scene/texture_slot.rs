//! The texture slots of a material, and the texture coordinates that they read.

use glam::Affine2;

/// A texture slot of a material. The first one with a texture, in this order, reads
/// [`Scene::texcoords`](super::Scene::texcoords) as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TextureSlot {
    /// Base colour (sRGB) and alpha.
    BaseColor,
    /// Roughness in green, metalness in blue.
    MetallicRoughness,
    /// Emitted colour, sRGB.
    Emissive,
    /// Normals in the tangent frame: each component is twice the channel minus one.
    Normal,
    /// Occlusion of ambient light in red: 0 is fully occluded.
    Occlusion,
    /// Transmission in red.
    Transmission,
    /// Strength of the dielectric reflection in alpha.
    Specular,
    /// Colour of the dielectric reflection, sRGB.
    SpecularColor,
    /// Specular reflectance (sRGB) and glossiness in alpha.
    SpecularGlossiness,
    /// Strength of the clearcoat in red.
    Clearcoat,
    /// Roughness of the clearcoat in green.
    ClearcoatRoughness,
    /// Colour of the sheen, sRGB.
    SheenColor,
    /// Roughness of the sheen in alpha.
    SheenRoughness,
    /// Direction of the anisotropy in the tangent frame in red and green, each twice the channel minus one; strength in
    /// blue.
    Anisotropy,
    /// Share of the surface that a thin film covers in red.
    Iridescence,
    /// Thickness of the film between its least and its greatest in green.
    IridescenceThickness,
    /// Share of the diffuse light that is transmitted in alpha.
    DiffuseTransmission,
    /// Colour of the light that is transmitted diffusely, sRGB.
    DiffuseTransmissionColor,
    /// Normals of the clearcoat in the tangent frame.
    ClearcoatNormal,
}

impl TextureSlot {
    /// All slots in order.
    pub const ALL: [Self; 19] = [
        Self::BaseColor,
        Self::MetallicRoughness,
        Self::Emissive,
        Self::Normal,
        Self::Occlusion,
        Self::Transmission,
        Self::Specular,
        Self::SpecularColor,
        Self::SpecularGlossiness,
        Self::Clearcoat,
        Self::ClearcoatRoughness,
        Self::SheenColor,
        Self::SheenRoughness,
        Self::Anisotropy,
        Self::Iridescence,
        Self::IridescenceThickness,
        Self::DiffuseTransmission,
        Self::DiffuseTransmissionColor,
        Self::ClearcoatNormal,
    ];

    /// The slot's name in messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::BaseColor => "base colour",
            Self::MetallicRoughness => "metallic-roughness",
            Self::Emissive => "emissive",
            Self::Normal => "normal",
            Self::Occlusion => "occlusion",
            Self::Transmission => "transmission",
            Self::Specular => "specular",
            Self::SpecularColor => "specular colour",
            Self::SpecularGlossiness => "specular-glossiness",
            Self::Clearcoat => "clearcoat",
            Self::ClearcoatRoughness => "clearcoat roughness",
            Self::SheenColor => "sheen colour",
            Self::SheenRoughness => "sheen roughness",
            Self::Anisotropy => "anisotropy",
            Self::Iridescence => "iridescence",
            Self::IridescenceThickness => "iridescence thickness",
            Self::DiffuseTransmission => "diffuse transmission",
            Self::DiffuseTransmissionColor => "diffuse transmission colour",
            Self::ClearcoatNormal => "clearcoat normal",
        }
    }

    /// Whether the slot's texels are sRGB-encoded colours.
    #[must_use]
    pub fn is_color(self) -> bool {
        matches!(
            self,
            Self::BaseColor
                | Self::Emissive
                | Self::SpecularColor
                | Self::SpecularGlossiness
                | Self::SheenColor
                | Self::DiffuseTransmissionColor
        )
    }
}

/// The texture coordinates of a slot that does not read [`Scene::texcoords`](super::Scene::texcoords) as they are:
/// an affine map of one of the two sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotCoordinates {
    /// Maps [`Scene::second_texcoords`](super::Scene::second_texcoords) instead of the first set.
    pub second: bool,
    /// The map.
    pub transform: Affine2,
}

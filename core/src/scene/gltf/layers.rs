//! Reads the material extensions of specular colours, specular-glossiness factors, clear coats, sheen, anisotropy,
//! iridescence, diffuse transmission, dispersion and absorption.

use glam::Vec3;
use gltf::json;
use json::texture::Info;
use serde_json::Value;

use super::materials::MAX_SCALE;
use super::normalized::Numbers;
use crate::scene::{
    MAX_DISPERSION, MAX_IOR, MAX_RADIANCE, MAX_THICKNESS, Material, SpecularGlossiness, TextureSlot,
};
use crate::{Error, Result};

const SPECULAR: &str = "KHR_materials_specular";
const GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";
const CLEARCOAT: &str = "KHR_materials_clearcoat";
const SHEEN: &str = "KHR_materials_sheen";
const ANISOTROPY: &str = "KHR_materials_anisotropy";
const DISPERSION: &str = "KHR_materials_dispersion";
const IRIDESCENCE: &str = "KHR_materials_iridescence";
const DIFFUSE_TRANSMISSION: &str = "KHR_materials_diffuse_transmission";

/// The textures of the extensions: slot, extension and property.
const TEXTURES: [(TextureSlot, &str, &str); 13] = [
    (TextureSlot::Specular, SPECULAR, "specularTexture"),
    (TextureSlot::SpecularColor, SPECULAR, "specularColorTexture"),
    (TextureSlot::SpecularGlossiness, GLOSSINESS, "specularGlossinessTexture"),
    (TextureSlot::Clearcoat, CLEARCOAT, "clearcoatTexture"),
    (TextureSlot::ClearcoatRoughness, CLEARCOAT, "clearcoatRoughnessTexture"),
    (TextureSlot::SheenColor, SHEEN, "sheenColorTexture"),
    (TextureSlot::SheenRoughness, SHEEN, "sheenRoughnessTexture"),
    (TextureSlot::Anisotropy, ANISOTROPY, "anisotropyTexture"),
    (TextureSlot::Iridescence, IRIDESCENCE, "iridescenceTexture"),
    (TextureSlot::IridescenceThickness, IRIDESCENCE, "iridescenceThicknessTexture"),
    (TextureSlot::DiffuseTransmission, DIFFUSE_TRANSMISSION, "diffuseTransmissionTexture"),
    (TextureSlot::DiffuseTransmissionColor, DIFFUSE_TRANSMISSION, "diffuseTransmissionColorTexture"),
    (TextureSlot::ClearcoatNormal, CLEARCOAT, "clearcoatNormalTexture"),
];

/// The least transmittance of a channel over the attenuation distance.
const LEAST_TRANSMITTANCE: f32 = 1.0e-6;

fn extension<'a>(json: &'a json::Material, name: &str) -> Option<&'a Value> {
    json.extensions.as_ref()?.others.get(name)
}

/// A number or an array of numbers of an extension; `default` where it is absent.
fn property<T: serde::de::DeserializeOwned>(
    extension: &Value,
    name: &str,
    default: T,
    what: &str,
) -> Result<T> {
    let Some(value) = extension.get(name) else { return Ok(default) };
    serde_json::from_value(value.clone()).map_err(|e| Error::scene(what, format!("{name}: {e}")))
}

/// Whether the material is a specular-glossiness one, whose metallic-roughness part does not count.
pub(super) fn is_glossiness(json: &json::Material) -> bool {
    extension(json, GLOSSINESS).is_some()
}

/// The texture of the diffuse colour of a specular-glossiness material.
pub(super) fn diffuse_texture(json: &json::Material, what: &str) -> Result<Option<Info>> {
    extension(json, GLOSSINESS).map_or(Ok(None), |e| property(e, "diffuseTexture", None, what))
}

/// The textures that the extensions have.
pub(super) fn textures(json: &json::Material, what: &str) -> Result<Vec<(TextureSlot, Info)>> {
    let mut found = Vec::new();
    for (slot, name, texture) in TEXTURES {
        if let Some(e) = extension(json, name) {
            found.extend(property::<Option<Info>>(e, texture, None, what)?.map(|info| (slot, info)));
        }
    }
    Ok(found)
}

/// Reads the factors of the extensions into a material.
pub(super) fn read(json: &json::Material, material: &mut Material, numbers: &mut Numbers<'_>) -> Result<()> {
    let what = numbers.what;
    if let Some(e) = extension(json, SPECULAR) {
        material.specular = numbers.share("specularFactor", property(e, "specularFactor", 1.0, what)?)?;
        let color = property(e, "specularColorFactor", [1.0_f32; 3], what)?;
        material.specular_color = within(color, "specularColorFactor", MAX_RADIANCE, numbers)?;
    }
    if let Some(e) = extension(json, GLOSSINESS) {
        let [r, g, b, a] = property(e, "diffuseFactor", [1.0_f32; 4], what)?;
        material.base_color = within([r, g, b], "diffuseFactor", 1.0, numbers)?;
        material.alpha = numbers.share("diffuseFactor", a)?;
        (material.metallic, material.roughness) = (0.0, 1.0);
        let specular = property(e, "specularFactor", [1.0_f32; 3], what)?;
        let glossiness = property(e, "glossinessFactor", 1.0, what)?;
        material.specular_glossiness = Some(SpecularGlossiness {
            specular: within(specular, "specularFactor", 1.0, numbers)?,
            glossiness: numbers.share("glossinessFactor", glossiness)?,
        });
    }
    if let Some(e) = extension(json, CLEARCOAT) {
        let roughness = property(e, "clearcoatRoughnessFactor", 0.0, what)?;
        material.clearcoat = numbers.share("clearcoatFactor", property(e, "clearcoatFactor", 0.0, what)?)?;
        material.clearcoat_roughness = numbers.share("clearcoatRoughnessFactor", roughness)?;
        if let Some(texture) = e.get("clearcoatNormalTexture") {
            let scale = property(texture, "scale", 1.0, what)?;
            let name = "clearcoatNormalTexture.scale";
            material.clearcoat_normal_scale = numbers.within(name, scale, -MAX_SCALE..=MAX_SCALE)?;
        }
    }
    if let Some(e) = extension(json, SHEEN) {
        let color = property(e, "sheenColorFactor", [0.0_f32; 3], what)?;
        material.sheen_color = within(color, "sheenColorFactor", 1.0, numbers)?;
        let roughness = property(e, "sheenRoughnessFactor", 0.0, what)?;
        material.sheen_roughness = numbers.share("sheenRoughnessFactor", roughness)?;
    }
    if let Some(e) = extension(json, ANISOTROPY) {
        let strength = property(e, "anisotropyStrength", 0.0, what)?;
        material.anisotropy = numbers.share("anisotropyStrength", strength)?;
        let rotation = property(e, "anisotropyRotation", 0.0_f32, what)?;
        let any = f32::MIN..=f32::MAX;
        material.anisotropy_rotation = numbers.within("anisotropyRotation", rotation, any)?;
    }
    if let Some(e) = extension(json, IRIDESCENCE) {
        let factor = property(e, "iridescenceFactor", 0.0, what)?;
        material.iridescence = numbers.share("iridescenceFactor", factor)?;
        let ior = property(e, "iridescenceIor", 1.3, what)?;
        material.iridescence_ior = numbers.within("iridescenceIor", ior, 1.0..=MAX_IOR)?;
        let ends = [("iridescenceThicknessMinimum", 100.0), ("iridescenceThicknessMaximum", 400.0)];
        for (thickness, (name, default)) in material.iridescence_thickness.iter_mut().zip(ends) {
            *thickness = numbers.within(name, property(e, name, default, what)?, 0.0..=MAX_THICKNESS)?;
        }
    }
    if let Some(e) = extension(json, DIFFUSE_TRANSMISSION) {
        let factor = property(e, "diffuseTransmissionFactor", 0.0, what)?;
        material.diffuse_transmission = numbers.share("diffuseTransmissionFactor", factor)?;
        let color = property(e, "diffuseTransmissionColorFactor", [1.0_f32; 3], what)?;
        let name = "diffuseTransmissionColorFactor";
        material.diffuse_transmission_color = within(color, name, 1.0, numbers)?;
    }
    if let Some(e) = extension(json, DISPERSION) {
        let dispersion = property(e, "dispersion", 0.0, what)?;
        material.dispersion = numbers.within("dispersion", dispersion, 0.0..=MAX_DISPERSION)?;
    }
    material.absorption = absorption(json, numbers)?;
    Ok(())
}

fn within(color: [f32; 3], name: &str, most: f32, numbers: &mut Numbers<'_>) -> Result<Vec3> {
    let mut checked = Vec3::ZERO;
    for (channel, value) in checked.as_mut().iter_mut().zip(color) {
        *channel = numbers.within(name, value, 0.0..=most)?;
    }
    Ok(checked)
}

/// Absorption coefficient of KHR_materials_volume: white light becomes the attenuation colour over the attenuation
/// distance.
fn absorption(json: &json::Material, numbers: &mut Numbers<'_>) -> Result<Vec3> {
    let volume = json.extensions.as_ref().and_then(|e| e.volume.as_ref());
    let Some(volume) = volume.filter(|v| v.attenuation_distance.0.is_finite()) else { return Ok(Vec3::ZERO) };
    let distance = volume.attenuation_distance.0;
    if distance <= 0.0 {
        return numbers.refused("attenuationDistance", "a number above 0", distance);
    }
    let color = within(volume.attenuation_color.0, "attenuationColor", 1.0, numbers)?;
    let transmittance = color.max(Vec3::splat(LEAST_TRANSMITTANCE));
    Ok((-transmittance.map(f32::ln) / distance).clamp(Vec3::ZERO, Vec3::splat(MAX_RADIANCE)))
}

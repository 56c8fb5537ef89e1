//! Converts glTF materials to [`Material`]s, each used one once.

use std::collections::HashMap;

use glam::Vec3;
use gltf::json;
use json::material::AlphaMode;
use json::validation::Checked;

use super::accessors::Source;
use super::container::External;
use super::images::Textures;
use super::layers;
use super::normalized::Numbers;
use super::slots::{self, Reads};
use super::text::{MAX_NAME, clipped};
use crate::scene::{MAX_IOR, MAX_RADIANCE, Material};
use crate::{Error, Result};

/// The largest factor on a normal map's slopes.
pub(super) const MAX_SCALE: f32 = 1.0e6;

/// An imported material: its index in the scene and the vertex attributes that it reads.
#[derive(Clone, Copy)]
pub(super) struct Imported {
    pub index: u32,
    pub reads: Reads,
}

/// The materials imported so far.
#[derive(Default)]
pub(super) struct Materials {
    pub materials: Vec<Material>,
    imported: HashMap<Option<usize>, Imported>,
}

impl Materials {
    /// The scene's material for a material of the file, imported on first use; `None` is glTF's default material.
    pub fn load(
        &mut self,
        source: &Source<'_>,
        external: &mut External<'_>,
        textures: &mut Textures,
        warnings: &mut Vec<String>,
        index: Option<usize>,
    ) -> Result<Imported> {
        if let Some(known) = self.imported.get(&index) {
            return Ok(*known);
        }
        let (material, reads) = match index {
            None => {
                let name = "default".into();
                let default = Material { name, metallic: 1.0, double_sided: false, ..Material::default() };
                (default, Reads::default())
            }
            Some(index) => {
                let all = &source.root.materials;
                let json = all.get(index).ok_or_else(|| {
                    Error::scene(
                        format!("material {index}"),
                        format!("no such material; the file has {}", all.len()),
                    )
                })?;
                let what = match &json.name {
                    Some(name) => format!("material {index} `{}`", clipped(name, MAX_NAME)),
                    None => format!("material {index}"),
                };
                let mut material = factors(json, &what, warnings)?;
                material.priority = priority(source, index, &what, warnings);
                let mut load = |texture: usize| textures.load(source, external, texture);
                let reads = slots::read(json, &what, &mut material, warnings, &mut load)?;
                if json.emissive_texture.is_some() && material.emissive_texture.is_none() {
                    // Without its texture, all of the surface would glow.
                    material.emission = Vec3::ZERO;
                }
                (material, reads)
            }
        };
        let imported = Imported { index: self.materials.len() as u32, reads };
        self.materials.push(material);
        self.imported.insert(index, imported);
        Ok(imported)
    }
}

/// Reads `extras.priority` of a material, by which solids that take up the same space are ordered.
fn priority(source: &Source<'_>, index: usize, what: &str, warnings: &mut Vec<String>) -> i8 {
    let Some(value) = source.document.pointer(&format!("/materials/{index}/extras/priority")) else {
        return 0;
    };
    serde_json::from_value(value.clone()).unwrap_or_else(|_| {
        let found = clipped(&value.to_string(), MAX_NAME);
        warnings.push(format!(
            "{what}: extras.priority: expected an integer from -128 to 127, found {found}; 0 is used"
        ));
        0
    })
}

/// Reads the factors of a material, without its textures.
fn factors(json: &json::Material, what: &str, warnings: &mut Vec<String>) -> Result<Material> {
    let mut numbers = Numbers { what, warnings };
    let pbr = &json.pbr_metallic_roughness;
    let [r, g, b, a] = pbr.base_color_factor.0;
    let base_color = [
        numbers.share("baseColorFactor", r)?,
        numbers.share("baseColorFactor", g)?,
        numbers.share("baseColorFactor", b)?,
    ];
    let alpha = numbers.share("baseColorFactor", a)?;
    let metallic = numbers.share("metallicFactor", pbr.metallic_factor.0)?;
    let roughness = numbers.share("roughnessFactor", pbr.roughness_factor.0)?;
    let emission = emission(json, &mut numbers)?;
    let extensions = json.extensions.as_ref();
    let ior =
        index_of_refraction(extensions.and_then(|e| e.ior.as_ref()).map_or(1.5, |e| e.ior.0), &numbers)?;
    let alpha_cutoff = alpha_cutoff(json, &mut numbers)?;
    let transmission = match extensions.and_then(|e| e.transmission.as_ref()) {
        Some(t) => numbers.share("transmissionFactor", t.transmission_factor.0)?,
        None => 0.0,
    };
    let volume = extensions.and_then(|e| e.volume.as_ref());
    let normal_scale = json.normal_texture.as_ref().map_or(1.0, |t| t.scale);
    let normal_scale = numbers.within("normalTexture.scale", normal_scale, -MAX_SCALE..=MAX_SCALE)?;
    let occlusion_strength = json.occlusion_texture.as_ref().map_or(1.0, |t| t.strength.0);
    let occlusion_strength = numbers.share("occlusionTexture.strength", occlusion_strength)?;
    let solid = volume.is_some_and(|v| v.thickness_factor.0 > 0.0);
    let mut material = Material {
        name: json.name.as_deref().map_or_else(|| what.to_owned(), |name| clipped(name, MAX_NAME)),
        base_color: base_color.into(),
        metallic,
        roughness,
        emission,
        transmission,
        ior,
        thin: transmission > 0.0 && !solid,
        unlit: extensions.is_some_and(|e| e.unlit.is_some()),
        alpha_cutoff,
        blends: json.alpha_mode == Checked::Valid(AlphaMode::Blend),
        alpha,
        double_sided: json.double_sided,
        casts_shadow: transmission == 0.0,
        normal_scale,
        occlusion_strength,
        ..Material::default()
    };
    layers::read(json, &mut material, &mut numbers)?;
    if !solid && transmission == 0.0 {
        material.absorption = Vec3::ZERO;
    }
    Ok(material)
}

fn emission(json: &json::Material, numbers: &mut Numbers<'_>) -> Result<Vec3> {
    let strength = json.extensions.as_ref().and_then(|e| e.emissive_strength.as_ref());
    let strength = strength.map_or(1.0, |e| e.emissive_strength.0);
    let name = "emissiveFactor x emissiveStrength";
    let mut emitted = json.emissive_factor.0.map(|factor| factor * strength);
    for value in &mut emitted {
        if value.is_nan() || *value > MAX_RADIANCE {
            return numbers.refused(name, &format!("a number up to {MAX_RADIANCE:e}"), *value);
        }
        *value = numbers.within(name, *value, 0.0..=MAX_RADIANCE)?;
    }
    Ok(emitted.into())
}

/// KHR_materials_ior allows 0 besides values from 1 on: total reflection, approximated by the largest index.
fn index_of_refraction(ior: f32, numbers: &Numbers<'_>) -> Result<f32> {
    match ior {
        0.0 => Ok(MAX_IOR),
        ior if (1.0..=MAX_IOR).contains(&ior) => Ok(ior),
        ior => numbers.refused("ior", &format!("0 or a number from 1 to {MAX_IOR}"), ior),
    }
}

fn alpha_cutoff(json: &json::Material, numbers: &mut Numbers<'_>) -> Result<Option<f32>> {
    match json.alpha_mode {
        Checked::Valid(AlphaMode::Opaque | AlphaMode::Blend) => Ok(None),
        Checked::Valid(AlphaMode::Mask) => {
            let cutoff = json.alpha_cutoff.map_or(0.5, |c| c.0);
            numbers.within("alphaCutoff", cutoff, 0.0..=f32::MAX).map(Some)
        }
        Checked::Invalid => {
            Err(Error::scene(numbers.what, "alphaMode: expected OPAQUE, MASK or BLEND, found another"))
        }
    }
}

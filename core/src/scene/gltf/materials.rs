//! Converts glTF materials to [`Material`]s, each used one once.

use std::collections::HashMap;

use glam::{DMat2, DVec2, Vec2, Vec3};
use gltf::json;
use json::extensions::texture::TextureTransform;
use json::material::AlphaMode;
use json::texture::Info;
use json::validation::Checked;

use super::accessors::Source;
use super::container::External;
use super::images::Textures;
use super::normalized::{Numbers, flushed2};
use super::text::{MAX_NAME, clipped};
use crate::scene::{MAX_IOR, MAX_RADIANCE, Material};
use crate::{Error, Result};

/// The texture coordinates that a material reads, and their transform (KHR_texture_transform).
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Coordinates {
    /// Index n of the attribute TEXCOORD_n.
    pub set: u32,
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
}

impl Coordinates {
    fn of(info: &Info) -> Self {
        let default = TextureTransform::default();
        let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
        let t = transform.unwrap_or(&default);
        Self {
            set: t.tex_coord.unwrap_or(info.tex_coord),
            offset: t.offset.0,
            rotation: t.rotation.0,
            scale: t.scale.0,
        }
    }

    /// Applies offset, rotation and scale. Rotation is counter-clockwise in the image, where v grows downwards:
    /// this is the matrix that viewers use, not the listing in the extension's text (KhronosGroup/glTF issue
    /// 1563).
    pub fn transform(&self, uv: [f32; 2]) -> Vec2 {
        let (sin, cos) = f64::from(self.rotation).sin_cos();
        let rotation = DMat2::from_cols_array(&[cos, -sin, sin, cos]);
        let scaled = Vec2::from(uv).as_dvec2() * Vec2::from(self.scale).as_dvec2();
        let moved: DVec2 = rotation * scaled + Vec2::from(self.offset).as_dvec2();
        flushed2(moved.as_vec2())
    }
}

/// An imported material: its index in the scene and the texture coordinates that it reads.
#[derive(Clone, Copy)]
pub(super) struct Imported {
    pub index: u32,
    pub coordinates: Option<Coordinates>,
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
        let (material, coordinates) = match index {
            None => (Material { name: "default".into(), metallic: 1.0, ..Material::default() }, None),
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
                let mut load = |texture: usize| textures.load(source, external, texture);
                let coordinates = slots(json, &what, &mut material, warnings, &mut load)?;
                (material, coordinates)
            }
        };
        let imported = Imported { index: self.materials.len() as u32, coordinates };
        self.materials.push(material);
        self.imported.insert(index, imported);
        Ok(imported)
    }
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
    let solid = volume.is_some_and(|v| v.thickness_factor.0 > 0.0);
    Ok(Material {
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
        alpha,
        casts_shadow: transmission == 0.0,
        ..Material::default()
    })
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
        Checked::Valid(AlphaMode::Opaque) => Ok(None),
        Checked::Valid(AlphaMode::Mask) => {
            let cutoff = json.alpha_cutoff.map_or(0.5, |c| c.0);
            numbers.within("alphaCutoff", cutoff, 0.0..=f32::MAX).map(Some)
        }
        Checked::Valid(AlphaMode::Blend) => Ok(Some(0.5)),
        Checked::Invalid => {
            Err(Error::scene(numbers.what, "alphaMode: expected OPAQUE, MASK or BLEND, found another"))
        }
    }
}

/// Reads the textures of a material. The first slot with a texture determines the texture coordinates; slots with
/// others are dropped, with a warning.
fn slots(
    json: &json::Material,
    what: &str,
    material: &mut Material,
    warnings: &mut Vec<String>,
    load: &mut dyn FnMut(usize) -> Result<Option<u32>>,
) -> Result<Option<Coordinates>> {
    let pbr = &json.pbr_metallic_roughness;
    let slots = [
        ("base colour", &pbr.base_color_texture, &mut material.base_color_texture),
        ("metallic-roughness", &pbr.metallic_roughness_texture, &mut material.metallic_roughness_texture),
        ("emissive", &json.emissive_texture, &mut material.emissive_texture),
    ];
    let mut common = None;
    for (name, info, slot) in slots {
        let Some(info) = info else { continue };
        let coordinates = Coordinates::of(info);
        if common.is_some_and(|c| c != coordinates) {
            warnings.push(format!(
                "{what}: its {name} texture is dropped, for it has another coordinate set or transform \
                 than the textures before it"
            ));
            continue;
        }
        *slot = load(info.index.value())?;
        if slot.is_some() {
            common = Some(coordinates);
        } else {
            warnings.push(format!("{what}: its {name} texture is dropped, for it has no PNG or JPEG image"));
        }
    }
    Ok(common)
}

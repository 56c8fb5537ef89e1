//! Reads the texture slots of materials, each with its set of texture coordinates and its KHR_texture_transform.

use std::collections::BTreeMap;

use glam::{Affine2, DAffine2, DMat2, DVec2, Vec2};
use gltf::json;
use json::extensions::texture::TextureTransform;
use json::texture::Info;
use serde_json::{Map, Value};

use super::images::Loaded;
use super::layers;
use super::normalized::flushed2;
use crate::scene::{Material, SlotCoordinates, TextureSlot};
use crate::{Error, Result};

const TRANSFORM: &str = "KHR_texture_transform";

/// The texture coordinates that a slot reads, and their transform (KHR_texture_transform).
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Coordinates {
    /// Index n of the attribute TEXCOORD_n.
    pub set: u32,
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
}

/// The vertex attributes that a material's textures read.
#[derive(Clone, Copy, Default)]
pub(super) struct Reads {
    /// The coordinates of the first slot with a texture, stored transformed.
    pub first: Option<Coordinates>,
    /// Index n of the attribute TEXCOORD_n that other slots read, stored as it is.
    pub second: Option<u32>,
    /// Whether some texture is read.
    pub textured: bool,
    /// The coordinates that tangents follow, where the material reads tangents: those of the first slot or others.
    pub tangents: Option<Option<SlotCoordinates>>,
}

/// A texture slot of the file.
struct Slot {
    slot: TextureSlot,
    texture: usize,
    coordinates: Coordinates,
}

impl Slot {
    fn of(slot: TextureSlot, info: &Info) -> Self {
        let transform = info.extensions.as_ref().and_then(|e| e.texture_transform.as_ref());
        let coordinates = Coordinates::of(transform.unwrap_or(&TextureTransform::default()), info.tex_coord);
        Self { slot, texture: info.index.value(), coordinates }
    }

    /// A slot whose extensions are plain JSON.
    fn with(
        slot: TextureSlot,
        texture: usize,
        set: u32,
        extensions: Option<&Map<String, Value>>,
        what: &str,
    ) -> Result<Self> {
        let transform = extensions.and_then(|e| e.get(TRANSFORM)).map(|value| {
            serde_json::from_value(value.clone()).map_err(|e| {
                Error::scene(format!("{what}, {} texture", slot.name()), format!("{TRANSFORM}: {e}"))
            })
        });
        let coordinates = Coordinates::of(&transform.transpose()?.unwrap_or_default(), set);
        Ok(Self { slot, texture, coordinates })
    }
}

impl Coordinates {
    fn of(t: &TextureTransform, set: u32) -> Self {
        Self { set: t.tex_coord.unwrap_or(set), offset: t.offset.0, rotation: t.rotation.0, scale: t.scale.0 }
    }

    /// Offset, rotation and scale. Rotation is counter-clockwise in the image, where v grows downwards: this is the
    /// matrix that viewers use, not the listing in the extension's text (KhronosGroup/glTF issue 1563).
    fn matrix(&self) -> DAffine2 {
        let (sin, cos) = f64::from(self.rotation).sin_cos();
        let rotation = DMat2::from_cols_array(&[cos, -sin, sin, cos]);
        let [scale, offset] = [self.scale, self.offset].map(|v| Vec2::from(v).as_dvec2());
        DAffine2::from_mat2_translation(rotation * DMat2::from_diagonal(scale), offset)
    }

    pub fn transform(&self, uv: [f32; 2]) -> Vec2 {
        let moved: DVec2 = self.matrix().transform_point2(Vec2::from(uv).as_dvec2());
        flushed2(moved.as_vec2())
    }

    /// The transform that makes these coordinates of `first`; `None` if `first` is flat.
    fn relative_to(&self, first: &Self) -> Option<Affine2> {
        let of = first.matrix();
        let relative = self.matrix() * of.inverse();
        (of.matrix2.determinant() != 0.0 && relative.is_finite()).then(|| relative.as_affine2())
    }
}

/// The slots that have a texture, in the order of [`TextureSlot`].
fn slots(json: &json::Material, what: &str) -> Result<Vec<Slot>> {
    let pbr = &json.pbr_metallic_roughness;
    let mut slots = Vec::new();
    let diffuse = layers::diffuse_texture(json, what)?;
    let (base, rough) = if layers::is_glossiness(json) {
        (diffuse.as_ref(), None)
    } else {
        (pbr.base_color_texture.as_ref(), pbr.metallic_roughness_texture.as_ref())
    };
    slots.extend(base.map(|i| Slot::of(TextureSlot::BaseColor, i)));
    slots.extend(rough.map(|i| Slot::of(TextureSlot::MetallicRoughness, i)));
    slots.extend(json.emissive_texture.as_ref().map(|i| Slot::of(TextureSlot::Emissive, i)));
    if let Some(t) = &json.normal_texture {
        let others = t.extensions.as_ref().map(|e| &e.others);
        slots.push(Slot::with(TextureSlot::Normal, t.index.value(), t.tex_coord, others, what)?);
    }
    if let Some(t) = &json.occlusion_texture {
        let others = t.extensions.as_ref().map(|e| &e.others);
        slots.push(Slot::with(TextureSlot::Occlusion, t.index.value(), t.tex_coord, others, what)?);
    }
    let transmission = json.extensions.as_ref().and_then(|e| e.transmission.as_ref());
    let transmission = transmission.and_then(|t| t.transmission_texture.as_ref());
    slots.extend(transmission.map(|i| Slot::of(TextureSlot::Transmission, i)));
    slots.extend(layers::textures(json, what)?.iter().map(|(slot, info)| Slot::of(*slot, info)));
    Ok(slots)
}

/// Reads the textures of a material. A slot that reads a third set of texture coordinates is dropped, with a
/// warning.
pub(super) fn read(
    json: &json::Material,
    what: &str,
    material: &mut Material,
    warnings: &mut Vec<String>,
    load: &mut dyn FnMut(usize) -> Result<Loaded>,
) -> Result<Reads> {
    let mut reads = Reads::default();
    let mut coordinates = BTreeMap::new();
    for Slot { slot, texture, coordinates: own } in slots(json, what)? {
        let used = match slot {
            TextureSlot::Anisotropy => material.is_anisotropic(),
            TextureSlot::ClearcoatNormal => material.clearcoat > 0.0,
            TextureSlot::Iridescence | TextureSlot::IridescenceThickness => material.is_iridescent(),
            TextureSlot::DiffuseTransmission | TextureSlot::DiffuseTransmissionColor => {
                material.is_translucent()
            }
            _ => true,
        };
        if !used {
            continue;
        }
        let name = slot.name();
        let relative = match &reads.first {
            None => None,
            Some(first) if *first == own => None,
            Some(first) => {
                let transform = if first.set == own.set { own.relative_to(first) } else { None };
                Some(transform.map_or(
                    SlotCoordinates { second: true, transform: own.matrix().as_affine2() },
                    |transform| SlotCoordinates { second: false, transform },
                ))
            }
        };
        let second = relative.is_some_and(|r| r.second);
        if second && reads.second.is_some_and(|set| set != own.set) {
            warnings.push(format!(
                "{what}: its {name} texture is dropped, for it reads a third set of texture coordinates,                  TEXCOORD_{}",
                own.set
            ));
            continue;
        }
        let texture = match load(texture)? {
            Ok(texture) => texture,
            Err(reason) => {
                warnings.push(format!("{what}: its {name} texture is dropped, for {reason}"));
                continue;
            }
        };
        match slot {
            TextureSlot::BaseColor => material.base_color_texture = Some(texture),
            TextureSlot::MetallicRoughness => material.metallic_roughness_texture = Some(texture),
            TextureSlot::Emissive => material.emissive_texture = Some(texture),
            other => drop(material.maps.insert(other, texture)),
        }
        if reads.first.is_none() {
            reads.first = Some(own);
        }
        if second {
            reads.second = Some(own.set);
        }
        coordinates.extend(relative.map(|relative| (slot, relative)));
        let oriented =
            matches!(slot, TextureSlot::Normal | TextureSlot::Anisotropy | TextureSlot::ClearcoatNormal);
        if oriented && reads.tangents.is_none() {
            reads.tangents = Some(relative);
        }
    }
    reads.textured = reads.first.is_some();
    if material.is_anisotropic() && reads.tangents.is_none() {
        reads.first.get_or_insert(Coordinates::of(&TextureTransform::default(), 0));
        reads.tangents = Some(None);
    }
    material.coordinates = coordinates;
    Ok(reads)
}

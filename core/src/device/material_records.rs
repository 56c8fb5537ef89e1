//! Data of extended materials, behind the objects in the same storage: a record for each material, then tables of
//! tangents and of second texture coordinates by primitive. A record is: places of the tables, scale of normals,
//! strength of occlusion; specular colour and strength, or specular reflectance and glossiness; absorption, flags;
//! clearcoat, its roughness and the scale of its normals; sheen's colour and roughness; the slots; strength of anisotropy, cosine and sine of its
//! rotation; strength of iridescence, index of the film, least and greatest thickness;
//! colour and share of diffuse transmission; dispersion.

use glam::{Affine2, Vec4};

use super::atlas::Atlas;
use crate::scene::{Material, Scene, TextureSlot};

/// Four words, the unit in which records are read.
type Words = [u32; 4];

/// Place of the first slot in a record, and words per slot: the texture's place, the transform's columns, its offset
/// and which set it maps.
pub const RECORD_SLOTS: u32 = 5;
pub const SLOT_PARTS: u32 = 3;

/// Place of the anisotropy in a record.
pub const RECORD_ANISOTROPY: u32 = RECORD_SLOTS + SLOT_PARTS * TextureSlot::ALL.len() as u32;
/// Place of the iridescence.
pub const RECORD_IRIDESCENCE: u32 = RECORD_ANISOTROPY + 1;
/// Place of the diffuse transmission.
pub const RECORD_TRANSLUCENCY: u32 = RECORD_IRIDESCENCE + 1;
/// Place of the dispersion.
pub const RECORD_DISPERSION: u32 = RECORD_TRANSLUCENCY + 1;
/// Size of a record.
const RECORD_PARTS: u32 = RECORD_DISPERSION + 1;

/// Flag in the place of the table of tangents: the material has a normal map, or its coat has.
pub const RECORD_NORMAL_MAP: u32 = 1 << 31;
/// Flag in the third part of a record: the material has specular-glossiness factors.
pub const RECORD_SPECULAR_GLOSSINESS: u32 = 1;

/// Sets of texture coordinates in a slot's third word: the first as it is, or one of the two with a transform.
pub const SET_FIRST: u32 = 1;
pub const SET_SECOND: u32 = 2;

/// Records and tables from a place in the storage on.
pub struct Records {
    /// Words of the records and tables.
    pub words: Vec<Words>,
    /// The place of each material's record; 0 for materials without one.
    pub places: Vec<u32>,
}

impl Records {
    /// The records of a scene's extended materials, which begin at `start`; `order` lists the primitives in the
    /// order of the tree.
    pub fn of(scene: &Scene, order: &[u32], atlas: &Atlas, start: u32) -> Self {
        let extended = scene.materials.iter().filter(|m| m.is_extended()).count() as u32;
        if extended == 0 {
            return Self { words: Vec::new(), places: vec![0; scene.materials.len()] };
        }
        let tangents = start + extended * RECORD_PARTS;
        let second = if scene.tangents.is_empty() { tangents } else { tangents + order.len() as u32 };
        let mut records = Self { words: Vec::new(), places: Vec::new() };
        for material in &scene.materials {
            let place = start + records.words.len() as u32;
            records.places.push(if material.is_extended() { place } else { 0 });
            if material.is_extended() {
                records.words.extend(record(material, atlas, [tangents, second]));
            }
        }
        if !scene.tangents.is_empty() {
            records.words.extend(order.iter().map(|i| {
                let [a, b, c] = scene.tangents.get(*i as usize).copied().unwrap_or_default();
                [a, b, c, 0]
            }));
        }
        if !scene.second_texcoords.is_empty() {
            records.words.extend(order.iter().flat_map(|i| {
                let corners = scene.second_texcoords.get(*i as usize).copied().unwrap_or_default();
                let [a, b, c] = corners.map(|t| t.to_array().map(f32::to_bits));
                [[a[0], a[1], b[0], b[1]], [c[0], c[1], 0, 0]]
            }));
        }
        records
    }
}

/// A material's record. `tables` are the places of tangents and second coordinates.
fn record(m: &Material, atlas: &Atlas, [tangents, second]: [u32; 2]) -> Vec<Words> {
    let bumpy = if m.bends_normals() { RECORD_NORMAL_MAP } else { 0 };
    let mapped = if m.reads_tangents() { tangents | bumpy } else { 0 };
    let twice = if m.coordinates.values().any(|c| c.second) { second } else { 0 };
    let (reflectance, strength, flags) = match m.specular_glossiness {
        Some(s) => (s.specular, s.glossiness, RECORD_SPECULAR_GLOSSINESS),
        None => (m.specular_color, m.specular, 0),
    };
    let solid = (m.transmission > 0.0 || m.is_translucent()) && !m.thin;
    let floats = |v: Vec4| v.to_array().map(f32::to_bits);
    let mut absorption = floats(if solid { m.absorption.extend(0.0) } else { Vec4::ZERO });
    absorption[3] = flags;
    let mut words = vec![
        [mapped, twice, m.normal_scale.to_bits(), m.occlusion_strength.to_bits()],
        floats(reflectance.extend(strength)),
        absorption,
        floats(Vec4::new(m.clearcoat, m.clearcoat_roughness, m.clearcoat_normal_scale, 0.0)),
        floats(m.sheen_color.extend(m.sheen_roughness)),
    ];
    for slot in TextureSlot::ALL {
        let coordinates = m.coordinates.get(&slot);
        let transform = coordinates.map_or(Affine2::IDENTITY, |c| c.transform);
        let [x, y] = transform.matrix2.to_cols_array_2d().map(|column| column.map(f32::to_bits));
        let [s, t] = transform.translation.to_array().map(f32::to_bits);
        let set = coordinates.map_or(0, |c| if c.second { SET_SECOND } else { SET_FIRST });
        words.extend([atlas.place(m.texture(slot)), [x[0], x[1], y[0], y[1]], [s, t, set, 0]]);
    }
    let (sine, cosine) = m.anisotropy_rotation.sin_cos();
    words.push(floats(Vec4::new(m.anisotropy, cosine, sine, 0.0)));
    let [thin, thick] = m.iridescence_thickness;
    words.push(floats(Vec4::new(m.iridescence, m.iridescence_ior, thin, thick)));
    words.push(floats(m.diffuse_transmission_color.extend(m.diffuse_transmission)));
    words.push(floats(Vec4::new(m.dispersion, 0.0, 0.0, 0.0)));
    words
}

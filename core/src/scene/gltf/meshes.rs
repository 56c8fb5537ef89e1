//! Converts mesh primitives to world-space triangles.

use glam::{DVec3, Vec2};
use gltf::json;
use json::accessor::Type;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked;

use super::accessors::{Accessor, Source};
use super::materials::Imported;
use super::nodes::Placed;
use super::slots::{Coordinates, Reads};
use super::tangents;
use super::vertices::Vertices;
use crate::scene::{Object, Scene, octahedral_encode};
use crate::{Error, Result};

/// Opaque white as packed RGBA, 8 bits a channel: the colour of vertices without COLOR_0.
const WHITE: u32 = u32::MAX;

/// A mesh primitive whose accessors were checked to lie inside the file's bytes.
pub(super) struct Mesh<'b> {
    /// Name of the primitive in error messages, such as `mesh 3 primitive 0`.
    pub what: String,
    mode: Mode,
    pub indices: Option<Accessor<'b>>,
    pub positions: Accessor<'b>,
    pub normals: Option<Accessor<'b>>,
    pub colors: Option<Accessor<'b>>,
    /// The texture coordinates that the material's first texture reads.
    pub texcoords: Option<(Coordinates, Accessor<'b>)>,
    /// The set that other textures read, and its index.
    pub second: Option<(u32, Accessor<'b>)>,
    /// Tangents, where the material has a normal map.
    pub tangents: Option<Accessor<'b>>,
}

impl<'b> Mesh<'b> {
    /// Opens a primitive with the attributes that its material reads. `None` if it has no triangles.
    pub fn open(
        source: &Source<'b>,
        primitive: &Primitive,
        reads: Reads,
        what: String,
        warnings: &mut Vec<String>,
    ) -> Result<Option<Self>> {
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
            Checked::Valid(_) => return Ok(None),
            Checked::Invalid => {
                return Err(Error::scene(what, "mode: expected 0 to 6, found another"));
            }
        };
        let attribute = |semantic: Semantic, shapes: &[Type]| {
            let name = semantic.to_string();
            let index = primitive.attributes.get(&Checked::Valid(semantic));
            let open = |i: &json::Index<json::Accessor>| {
                source.accessor(i.value(), &format!("{what}, {name}"), shapes)
            };
            index.map(open).transpose()
        };
        let Some(positions) = attribute(Semantic::Positions, &[Type::Vec3])? else {
            warnings.push(format!("{what}: without POSITION it is left out"));
            return Ok(None);
        };
        let indices = primitive.indices.map(|i| {
            let what = format!("{what}, indices");
            let accessor = source.accessor(i.value(), &what, &[Type::Scalar])?;
            if accessor.is_unsigned() {
                Ok(accessor)
            } else {
                Err(Error::scene(what, "expected unsigned integers, found another component type"))
            }
        });
        let mut texcoords = Vec::new();
        for semantic in primitive.attributes.keys() {
            if let Checked::Valid(Semantic::TexCoords(set)) = semantic {
                texcoords.extend(attribute(Semantic::TexCoords(*set), &[Type::Vec2])?.map(|a| (*set, a)));
            }
        }
        let normals = attribute(Semantic::Normals, &[Type::Vec3])?;
        // Without normals, tangents are to be ignored.
        let reads_tangents = reads.normal_map.is_some() && normals.is_some();
        let tangents = if reads_tangents { attribute(Semantic::Tangents, &[Type::Vec4])? } else { None };
        let colors = attribute(Semantic::Colors(0), &[Type::Vec3, Type::Vec4])?;
        let lengths = texcoords.iter().map(|(set, a)| (format!("TEXCOORD_{set}"), a));
        let lengths = lengths.chain(normals.iter().map(|a| ("NORMAL".to_owned(), a)));
        let lengths = lengths.chain(tangents.iter().map(|a| ("TANGENT".to_owned(), a)));
        for (name, accessor) in lengths.chain(colors.iter().map(|a| ("COLOR_0".to_owned(), a))) {
            if accessor.count != positions.count {
                return Err(Error::scene(
                    format!("{what}, {name}"),
                    format!(
                        "expected {} elements as POSITION has, found {}",
                        positions.count, accessor.count
                    ),
                ));
            }
        }
        let indices = indices.transpose()?;
        let mut take = |set: u32| {
            let found = texcoords.iter().position(|(n, _)| *n == set).map(|i| texcoords.swap_remove(i));
            if found.is_none() {
                warnings.push(format!("{what}: without TEXCOORD_{set} its textures are read at (0, 0)"));
            }
            found
        };
        let first = reads.first.and_then(|c| take(c.set).map(|(_, accessor)| (c, accessor)));
        let second = match (reads.second, &first) {
            (Some(set), Some((c, accessor))) if c.set == set => Some((set, accessor.clone())),
            (Some(set), _) => take(set),
            (None, _) => None,
        };
        let texcoords = first;
        Ok(Some(Self { what, mode, indices, positions, normals, colors, texcoords, second, tangents }))
    }

    /// Number of triangles of the primitive.
    pub fn triangles(&self) -> usize {
        let corners = self.indices.as_ref().map_or(self.positions.count, |i| i.count);
        match self.mode {
            Mode::Triangles => corners / 3,
            _ => corners.saturating_sub(2),
        }
    }

    /// Indices of the vertices of triangle `i` (glTF 2.0, section 3.7.2.1).
    fn corners(&self, i: usize) -> [usize; 3] {
        let order = match self.mode {
            Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Mode::TriangleFan => [i + 1, i + 2, 0],
            _ => [3 * i, 3 * i + 1, 3 * i + 2],
        };
        match &self.indices {
            Some(indices) => order.map(|corner| indices.index(corner) as usize),
            None => order,
        }
    }

    /// Adds the triangles as one object and returns how many were left out for having no area. If none remain, no
    /// object is added.
    pub fn add(
        &self,
        node: &Placed<'_>,
        name: String,
        material: Imported,
        scene: &mut Scene,
    ) -> Result<usize> {
        let vertices = Vertices::of(self, node)?;
        let mirrored = node.mirrors();
        let before = scene.positions.len();
        let object = scene.objects.len() as u32;
        for i in 0..self.triangles() {
            let mut corners = self.corners(i).map(|c| vertices.place(c));
            if mirrored {
                corners.swap(1, 2);
            }
            let positions = corners.map(|c| vertices.positions[c]);
            let [a, b, c] = positions.map(|p| p.as_dvec3());
            let face = (b - a).cross(c - a);
            if face == DVec3::ZERO {
                continue;
            }
            let flat = octahedral_encode(face.normalize().as_vec3());
            scene.positions.push(positions);
            scene.normals.push(corners.map(|c| vertices.normals.get(c).copied().flatten().unwrap_or(flat)));
            scene.triangle_objects.push(object);
            if !vertices.texcoords.is_empty() {
                scene.texcoords.reserve_exact(scene.positions.capacity() - scene.texcoords.len());
                scene.texcoords.resize(scene.positions.len() - 1, [Vec2::ZERO; 3]);
                scene.texcoords.push(corners.map(|c| vertices.texcoords[c]));
            }
            if !vertices.second.is_empty() {
                scene
                    .second_texcoords
                    .reserve_exact(scene.positions.capacity() - scene.second_texcoords.len());
                scene.second_texcoords.resize(scene.positions.len() - 1, [Vec2::ZERO; 3]);
                scene.second_texcoords.push(corners.map(|c| vertices.second[c]));
            }
            if !vertices.tangents.is_empty() {
                scene.tangents.reserve_exact(scene.positions.capacity() - scene.tangents.len());
                scene.tangents.resize(scene.positions.len() - 1, [0; 3]);
                scene.tangents.push(corners.map(|c| vertices.tangents[c]));
            }
            if !vertices.colors.is_empty() {
                scene.colors.reserve_exact(scene.positions.capacity() - scene.colors.len());
                scene.colors.resize(scene.positions.len() - 1, [WHITE; 3]);
                scene.colors.push(corners.map(|c| vertices.colors[c]));
            }
        }
        let kept = scene.positions.len() - before;
        if let Some(coordinates) =
            material.reads.normal_map.filter(|_| vertices.tangents.is_empty() && kept > 0)
        {
            drop(vertices);
            let computed = tangents::computed(scene, before..scene.positions.len(), coordinates)?;
            scene.tangents.reserve_exact(scene.positions.capacity() - scene.tangents.len());
            scene.tangents.resize(before, [0; 3]);
            scene.tangents.extend(computed);
        }
        if kept > 0 {
            scene.objects.push(Object { name, material: material.index });
        }
        Ok(self.triangles() - kept)
    }
}

//! Converts mesh primitives to world-space triangles.

use glam::{DVec3, Vec2};
use gltf::json;
use json::accessor::Type;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked;

use super::accessors::{Accessor, Source};
use super::attributes::Attributes;
use super::deformation::Deformation;
use super::materials::Imported;
use super::pose::Placement;
use super::slots::{Coordinates, Reads};
use super::tangents;
use super::thin::{PRIMITIVES_OF_LINE, Thin};
use super::vertices::Vertices;
use crate::scene::{Object, Scene, WHITE, octahedral_encode};
use crate::{Error, Result};

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
    pub deformation: Deformation<'b>,
}

/// What was done to the triangles and vertices of an object.
pub(super) struct Added {
    /// Number of triangles left out for having no area.
    pub without_area: usize,
    /// Number of vertices whose weights did not sum to 1.
    pub unnormalized: usize,
}

impl<'b> Mesh<'b> {
    /// Opens a primitive with the attributes that its material reads. `None` without positions.
    pub fn open(
        source: &Source<'b>,
        primitive: &Primitive,
        reads: Reads,
        what: String,
        warnings: &mut Vec<String>,
    ) -> Result<Option<Self>> {
        let mode = match primitive.mode {
            Checked::Valid(mode) => mode,
            Checked::Invalid => {
                return Err(Error::scene(what, "mode: expected 0 to 6, found another"));
            }
        };
        let attributes = Attributes::of(source, primitive, &what)?;
        let mode = if attributes.is_compressed() { Mode::Triangles } else { mode };
        let Some(positions) = attributes.get(Semantic::Positions, &[Type::Vec3])? else {
            warnings.push(format!("{what}: without POSITION it is left out"));
            return Ok(None);
        };
        let mut texcoords = Vec::new();
        for semantic in primitive.attributes.keys() {
            if let Checked::Valid(Semantic::TexCoords(set)) = semantic {
                let accessor = attributes.get(Semantic::TexCoords(*set), &[Type::Vec2])?;
                texcoords.extend(accessor.map(|a| (*set, a)));
            }
        }
        let normals = attributes.get(Semantic::Normals, &[Type::Vec3])?;
        // Without normals, tangents are to be ignored.
        let reads_tangents = reads.tangents.is_some() && normals.is_some();
        let tangents = if reads_tangents { attributes.get(Semantic::Tangents, &[Type::Vec4])? } else { None };
        let colors = attributes.get(Semantic::Colors(0), &[Type::Vec3, Type::Vec4])?;
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
        let is_thin = !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan);
        if is_thin && (colors.is_some() || reads.textured) {
            warnings.push(format!("{what}: its points and lines have one colour, without textures"));
        }
        let indices = attributes.indices()?;
        let mut take = |set: u32| {
            let found = texcoords.iter().position(|(n, _)| *n == set).map(|i| texcoords.swap_remove(i));
            if found.is_none() && reads.textured {
                warnings.push(format!("{what}: without TEXCOORD_{set} its textures are read at (0, 0)"));
            } else if found.is_none() && tangents.is_none() {
                warnings.push(format!(
                    "{what}: without TANGENT and TEXCOORD_{set} its anisotropy has some direction of the surface"
                ));
            }
            found
        };
        let first = reads.first.and_then(|c| take(c.set).map(|(_, accessor)| (c, accessor)));
        let second = match (reads.second, &first) {
            (Some(set), Some((c, accessor))) if c.set == set => Some((set, accessor.clone())),
            (Some(set), _) => take(set),
            (None, _) => None,
        };
        let (texcoords, deformation) = (first, Deformation::default());
        Ok(Some(Self {
            what,
            mode,
            indices,
            positions,
            normals,
            colors,
            texcoords,
            second,
            tangents,
            deformation,
        }))
    }

    /// Number of vertices that the primitive's topology lists.
    fn listed(&self) -> usize {
        self.indices.as_ref().map_or(self.positions.count, |i| i.count)
    }

    /// Number of triangles of the primitive; of points and lines, that of the triangles and spheres that show them.
    pub fn triangles(&self) -> usize {
        match self.mode {
            Mode::Points => self.listed(),
            Mode::Lines | Mode::LineStrip | Mode::LineLoop => self.lines().saturating_mul(PRIMITIVES_OF_LINE),
            Mode::Triangles => self.listed() / 3,
            Mode::TriangleStrip | Mode::TriangleFan => self.listed().saturating_sub(2),
        }
    }

    fn lines(&self) -> usize {
        match self.mode {
            Mode::Lines => self.listed() / 2,
            Mode::LineStrip => self.listed().saturating_sub(1),
            Mode::LineLoop if self.listed() > 1 => self.listed(),
            _ => 0,
        }
    }

    /// Whether the primitive is points or lines.
    pub fn is_thin(&self) -> bool {
        matches!(self.mode, Mode::Points | Mode::Lines | Mode::LineStrip | Mode::LineLoop)
    }

    /// The points and lines of the primitive in a pose.
    pub fn thin(&self, placement: &Placement<'_>, name: String, material: Imported) -> Result<Thin> {
        let vertices = Vertices::of(self, placement)?;
        let position = |listed: usize| {
            let vertex = self.indices.as_ref().map_or(listed, |indices| indices.index(listed) as usize);
            vertices.positions[vertices.place(vertex)]
        };
        let ends = |line: usize| match self.mode {
            Mode::Lines => [2 * line, 2 * line + 1],
            _ => [line, (line + 1) % self.listed()],
        };
        let points = if self.mode == Mode::Points { self.listed() } else { 0 };
        Ok(Thin {
            name,
            material: material.index,
            lit: self.normals.is_some(),
            points: (0..points).map(position).collect(),
            lines: (0..self.lines()).map(|line| ends(line).map(position)).collect(),
        })
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

    /// Opens what deforms the primitive `json` in an instance that is `skinned` or not, with these weights of morph
    /// targets. Returns an upper bound on the number of vertices to deform, counted for every target and set of
    /// joints.
    pub fn deform(
        &mut self,
        source: &Source<'b>,
        json: &Primitive,
        skinned: bool,
        weights: &[f32],
    ) -> Result<usize> {
        let layers =
            self.deformation.open(source, json, &self.what, self.positions.count, skinned, weights)?;
        let used = self.indices.as_ref().map_or(usize::MAX, |i| i.count).min(self.positions.count);
        Ok(used.saturating_mul(layers))
    }

    /// Adds the triangles as one object, those without area left out. If none remain, no object is added.
    pub fn add(
        &self,
        placement: &Placement<'_>,
        name: String,
        material: Imported,
        scene: &mut Scene,
    ) -> Result<Added> {
        let vertices = Vertices::of(self, placement)?;
        let unnormalized = vertices.unnormalized;
        let without = vertices.normals.iter().filter(|normal| normal.is_none()).count();
        if without > 0 {
            let warning =
                format!("{}: {without} of its normals have no direction, the faces' count", self.what);
            // Instances have the same.
            if scene.warnings.last() != Some(&warning) {
                scene.warnings.push(warning);
            }
        }
        let before = scene.positions.len();
        let object = scene.objects.len() as u32;
        for i in 0..self.triangles() {
            let mut corners = self.corners(i).map(|c| vertices.place(c));
            if vertices.mirrors(corners[0]) {
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
            material.reads.tangents.filter(|_| vertices.tangents.is_empty() && kept > 0)
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
        Ok(Added { without_area: self.triangles() - kept, unnormalized })
    }
}

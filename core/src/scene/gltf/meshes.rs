//! Mesh primitives into world-space triangles.

use glam::{DMat3, DVec3, Vec2, Vec3};
use gltf::json;
use json::accessor::Type;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked;

use super::accessors::{Accessor, Source};
use super::materials::{Coordinates, Imported};
use super::nodes::Placed;
use crate::scene::{MAX_COORDINATE, Object, Scene, octahedral_encode};
use crate::{Error, Result};

/// White, opaque.
const WHITE: u32 = u32::MAX;

/// A primitive whose accessors lie inside the file's bytes.
pub(super) struct Mesh<'b> {
    /// `mesh 3 primitive 0`, for errors.
    what: String,
    mode: Mode,
    indices: Option<Accessor<'b>>,
    positions: Accessor<'b>,
    normals: Option<Accessor<'b>>,
    colors: Option<Accessor<'b>>,
    texcoords: Vec<(u32, Accessor<'b>)>,
}

/// Vertices `first..` of a primitive, in world space.
struct Vertices {
    first: usize,
    positions: Vec<Vec3>,
    /// `None` where the face's normal is to be taken.
    normals: Vec<Option<u32>>,
    texcoords: Vec<Vec2>,
    colors: Vec<u32>,
}

impl<'b> Mesh<'b> {
    /// `None` and a warning where there is nothing to draw.
    pub fn open(
        source: &Source<'b>,
        primitive: &Primitive,
        what: String,
        warnings: &mut Vec<String>,
    ) -> Result<Option<Self>> {
        let mode = match primitive.mode {
            Checked::Valid(mode @ (Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan)) => mode,
            Checked::Valid(_) => {
                warnings.push(format!("{what}: points and lines are left out"));
                return Ok(None);
            }
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
        let colors = attribute(Semantic::Colors(0), &[Type::Vec3, Type::Vec4])?;
        let lengths = texcoords.iter().map(|(set, a)| (format!("TEXCOORD_{set}"), a));
        let lengths = lengths.chain(normals.iter().map(|a| ("NORMAL".to_owned(), a)));
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
        Ok(Some(Self { what, mode, indices, positions, normals, colors, texcoords }))
    }

    /// How many triangles it has.
    pub fn triangles(&self) -> usize {
        let corners = self.indices.as_ref().map_or(self.positions.count, |i| i.count);
        match self.mode {
            Mode::Triangles => corners / 3,
            _ => corners.saturating_sub(2),
        }
    }

    /// The vertices of triangle `i` (glTF 2.0, section 3.7.2.1).
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

    /// The range of vertices that triangles use: files often share one large array among many primitives.
    fn used(&self) -> Result<std::ops::Range<usize>> {
        let count = self.positions.count;
        let Some(indices) = &self.indices else { return Ok(0..count) };
        let (mut low, mut high) = (usize::MAX, 0);
        for i in 0..indices.count {
            let index = indices.index(i) as usize;
            if index >= count {
                return Err(Error::scene(
                    format!("{}, indices", self.what),
                    format!("element {i} is {index}, but there are {count} vertices"),
                ));
            }
            (low, high) = (low.min(index), high.max(index + 1));
        }
        Ok(low.min(high)..high)
    }

    fn vertices(
        &self,
        node: &Placed<'_>,
        coordinates: Option<Coordinates>,
        warnings: &mut Vec<String>,
    ) -> Result<Vertices> {
        let used = self.used()?;
        let linear = DMat3::from_mat4(node.world);
        let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
        // The inverse transpose times the determinant, which exists for every matrix; only directions count.
        let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror(node);
        let bad = |name: &str, i: usize, found: &dyn std::fmt::Debug, expected: &str| {
            Error::scene(
                format!("{}, {name}", self.what),
                format!("element {i}: expected {expected}, found {found:?}"),
            )
        };
        let position = |i: usize| {
            let stored = self.positions.floats::<3>(i);
            let world = node.world.transform_point3(Vec3::from(stored).as_dvec3());
            if world.abs().max_element() <= f64::from(MAX_COORDINATE) {
                return Ok(world.as_vec3());
            }
            let found = if Vec3::from(stored).is_finite() { world.to_array() } else { stored.map(f64::from) };
            Err(bad("POSITION", i, &found, "finite coordinates up to 1e18 in the world"))
        };
        let normal = |accessor: &Accessor<'_>, i: usize| {
            let n = Vec3::from(accessor.floats::<3>(i));
            if !n.is_finite() {
                return Err(bad("NORMAL", i, &n.to_array(), "a finite vector"));
            }
            let n = (cofactors * n.as_dvec3()).normalize_or_zero();
            Ok((n != DVec3::ZERO).then(|| octahedral_encode(n.as_vec3())))
        };
        let normals = self.normals.as_ref();
        let normals = normals.map_or(Ok(Vec::new()), |a| used.clone().map(|i| normal(a, i)).collect())?;
        let mut texcoords = Vec::new();
        if let Some(c) = coordinates {
            let name = format!("TEXCOORD_{}", c.set);
            match self.texcoords.iter().find(|(set, _)| *set == c.set) {
                None => {
                    warnings.push(format!("{}: without {name} its textures are read at (0, 0)", self.what))
                }
                Some((_, accessor)) => {
                    let texcoord = |i: usize| {
                        let stored = accessor.floats::<2>(i);
                        let moved = c.transform(stored);
                        let finite = moved.is_finite().then_some(moved);
                        finite.ok_or_else(|| bad(&name, i, &stored, "finite coordinates"))
                    };
                    texcoords = used.clone().map(texcoord).collect::<Result<_>>()?;
                }
            }
        }
        let color = |accessor: &Accessor<'_>, i: usize| {
            let mut rgba = accessor.floats::<4>(i);
            if accessor.components == 3 {
                rgba[3] = 1.0;
            }
            if rgba.iter().any(|c| !c.is_finite()) {
                return Err(bad("COLOR_0", i, &rgba, "finite colours"));
            }
            Ok(u32::from_le_bytes(rgba.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)))
        };
        let colors = self.colors.as_ref();
        let colors = colors.map_or(Ok(Vec::new()), |a| used.clone().map(|i| color(a, i)).collect())?;
        let positions = used.clone().map(position).collect::<Result<_>>()?;
        Ok(Vertices { first: used.start, positions, normals, texcoords, colors })
    }

    /// Adds its triangles as one object, and returns how many had no area.
    pub fn add(
        &self,
        node: &Placed<'_>,
        name: String,
        material: Imported,
        scene: &mut Scene,
    ) -> Result<usize> {
        let vertices = self.vertices(node, material.coordinates, &mut scene.warnings)?;
        let mirrored = mirror(node) < 0.0;
        let before = scene.positions.len();
        let object = scene.objects.len() as u32;
        for i in 0..self.triangles() {
            let mut corners = self.corners(i).map(|c| c - vertices.first);
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
                scene.texcoords.resize(scene.positions.len() - 1, [Vec2::ZERO; 3]);
                scene.texcoords.push(corners.map(|c| vertices.texcoords[c]));
            }
            if !vertices.colors.is_empty() {
                scene.colors.resize(scene.positions.len() - 1, [WHITE; 3]);
                scene.colors.push(corners.map(|c| vertices.colors[c]));
            }
        }
        let kept = scene.positions.len() - before;
        if kept > 0 {
            scene.objects.push(Object { name, material: material.index });
            return Ok(self.triangles() - kept);
        }
        if self.triangles() > 0 {
            scene.warnings.push(format!("{name}: left out, for all its triangles have no area"));
        }
        Ok(0)
    }
}

/// -1 for a node that mirrors, else 1.
fn mirror(node: &Placed<'_>) -> f64 {
    if DMat3::from_mat4(node.world).determinant() < 0.0 { -1.0 } else { 1.0 }
}

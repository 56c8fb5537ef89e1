//! Transforms a primitive's vertices into world space.

use std::ops::Range;

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};

use super::accessors::Accessor;
use super::deformation::Displaced;
use super::meshes::Mesh;
use super::normalized::{flushed2, flushed3};
use super::pose::{Placement, Transform, cofactors, mirrors};
use crate::scene::{MAX_COORDINATE, octahedral_encode, tangent_encode};
use crate::{Error, Result};

/// The largest difference from 1 of the sum of a vertex's weights that is not told: above what weights of 8 bits
/// round to.
const WEIGHTS_TOLERANCE: f64 = 1.0e-2;

/// The vertices that triangles use. Many primitives of a file often share one large array, so the work must be
/// proportional to the triangles and not to the array.
enum Used {
    /// All vertices of a contiguous range of indices.
    Range(Range<usize>),
    /// Single vertices, by ascending index.
    Few(Vec<usize>),
}

impl Used {
    fn by(mesh: &Mesh<'_>) -> Result<Self> {
        let count = mesh.positions.count;
        let Some(indices) = &mesh.indices else { return Ok(Self::Range(0..count)) };
        let (mut low, mut high) = (usize::MAX, 0);
        for i in 0..indices.count {
            let index = indices.index(i) as usize;
            if index >= count {
                return Err(Error::scene(
                    format!("{}, indices", mesh.what),
                    format!("element {i} is {index}, but there are {count} vertices"),
                ));
            }
            (low, high) = (low.min(index), high.max(index + 1));
        }
        let range = low.min(high)..high;
        if range.len() <= indices.count {
            return Ok(Self::Range(range));
        }
        let mut few: Vec<_> = (0..indices.count).map(|i| indices.index(i) as usize).collect();
        few.sort_unstable();
        few.dedup();
        Ok(Self::Few(few))
    }

    fn map<T>(&self, vertex: impl FnMut(usize) -> Result<T>) -> Result<Vec<T>> {
        match self {
            Self::Range(range) => range.clone().map(vertex).collect(),
            Self::Few(few) => few.iter().copied().map(vertex).collect(),
        }
    }

    /// `vertex` of each used vertex of an attribute; none without the attribute.
    fn all<'a, 'b, T>(
        &self,
        accessor: &'a Option<Accessor<'b>>,
        mut vertex: impl FnMut(&'a Accessor<'b>, usize) -> Result<T>,
    ) -> Result<Vec<T>> {
        accessor.as_ref().map_or(Ok(Vec::new()), |a| self.map(|i| vertex(a, i)))
    }

    /// Position of a used vertex among the used ones.
    fn place(&self, vertex: usize) -> usize {
        match self {
            Self::Range(range) => vertex - range.start,
            Self::Few(few) => few.partition_point(|v| *v < vertex),
        }
    }
}

/// The used vertices of a primitive in world space.
pub(super) struct Vertices {
    used: Used,
    pub positions: Vec<Vec3>,
    /// Encoded normals; `None` stands for the face normal. Empty if the primitive has none, like the other
    /// attributes.
    pub normals: Vec<Option<u32>>,
    pub texcoords: Vec<Vec2>,
    pub second: Vec<Vec2>,
    /// Encoded tangents; also empty if some of the file's are not usable.
    pub tangents: Vec<u32>,
    pub colors: Vec<[u16; 4]>,
    /// Whether the transform mirrors: of all vertices, or of each one of a skinned primitive.
    mirrored: Vec<bool>,
    /// Number of vertices whose weights did not sum to 1.
    pub unnormalized: usize,
}

impl Vertices {
    /// The vertices of a primitive in the given pose.
    pub fn of(mesh: &Mesh<'_>, placement: &Placement<'_>) -> Result<Self> {
        let used = Used::by(mesh)?;
        let local = |i: usize| {
            let displacement = mesh.deformation.displacement(Displaced::Position, placement.weights, i);
            DVec3::from(mesh.positions.floats::<3>(i).map(f64::from)) + displacement
        };
        let mut mirrored = Vec::new();
        let mut unnormalized = 0;
        let (positions, normals, tangents): (_, _, Vec<Option<u32>>);
        match placement.transform {
            Transform::Rigid(world) => {
                mirrored.push(mirrors(&world));
                positions = used.map(|i| position(mesh, i, world.transform_point3(local(i))))?;
                let cofactors = cofactors(&world);
                normals =
                    used.all(&mesh.normals, |a, i| Ok(normal(mesh, a, placement.weights, &cofactors, i)))?;
                tangents =
                    used.all(&mesh.tangents, |a, i| Ok(tangent(mesh, a, placement.weights, &world, i)))?;
            }
            Transform::Skinned(joints) => {
                positions = used.map(|i| {
                    let blend = mesh.deformation.blend(&mesh.what, joints, i)?;
                    mirrored.push(mirrors(&blend.matrix));
                    unnormalized += usize::from((blend.sum - 1.0).abs() > WEIGHTS_TOLERANCE);
                    position(mesh, i, blend.matrix.transform_point3(local(i)))
                })?;
                normals = used.all(&mesh.normals, |a, i| {
                    let blend = mesh.deformation.blend(&mesh.what, joints, i)?;
                    Ok(normal(mesh, a, placement.weights, &cofactors(&blend.matrix), i))
                })?;
                tangents = used.all(&mesh.tangents, |a, i| {
                    let blend = mesh.deformation.blend(&mesh.what, joints, i)?;
                    Ok(tangent(mesh, a, placement.weights, &blend.matrix, i))
                })?;
            }
        }
        let texcoords = match &mesh.texcoords {
            None => Vec::new(),
            Some((coordinates, accessor)) => used.map(|i| {
                let stored = accessor.floats::<2>(i);
                texcoord(mesh, coordinates.set, i, stored, coordinates.transform(stored))
            })?,
        };
        let second = match &mesh.second {
            None => Vec::new(),
            Some((set, accessor)) => used.map(|i| {
                let stored = accessor.floats::<2>(i);
                texcoord(mesh, *set, i, stored, flushed2(stored.into()))
            })?,
        };
        let colors = used.all(&mesh.colors, |a, i| color(mesh, a, i))?;
        let tangents = tangents.into_iter().collect::<Option<_>>().unwrap_or_default();
        Ok(Self { used, positions, normals, texcoords, second, tangents, colors, mirrored, unnormalized })
    }

    /// Whether the transform of a vertex, by its place in the lists, mirrors.
    pub fn mirrors(&self, place: usize) -> bool {
        self.mirrored.get(place).or(self.mirrored.first()).is_some_and(|m| *m)
    }

    /// Position of a vertex of the primitive in the lists.
    pub fn place(&self, vertex: usize) -> usize {
        self.used.place(vertex)
    }
}

fn bad(
    mesh: &Mesh<'_>,
    attribute: std::fmt::Arguments<'_>,
    i: usize,
    found: &dyn std::fmt::Debug,
    expected: std::fmt::Arguments<'_>,
) -> Error {
    Error::scene(
        format!("{}, {attribute}", mesh.what),
        format!("element {i}: expected {expected}, found {found:?}"),
    )
}

fn position(mesh: &Mesh<'_>, i: usize, world: DVec3) -> Result<Vec3> {
    if world.abs().max_element() <= f64::from(MAX_COORDINATE) && !world.is_nan() {
        return Ok(flushed3(world.as_vec3()));
    }
    let stored = mesh.positions.floats::<3>(i);
    let found = if Vec3::from(stored).is_finite() { world.to_array() } else { stored.map(f64::from) };
    let expected = format_args!("finite coordinates up to {MAX_COORDINATE:e} in the world");
    Err(bad(mesh, format_args!("POSITION"), i, &found, expected))
}

/// The encoded normal of a vertex; `None`, which stands for the face's, where it has no direction.
fn normal(
    mesh: &Mesh<'_>,
    accessor: &Accessor<'_>,
    weights: &[f32],
    cofactors: &DMat3,
    i: usize,
) -> Option<u32> {
    let stored = accessor.floats::<3>(i);
    let displacement = mesh.deformation.displacement(Displaced::Normal, weights, i);
    let n = DVec3::from(stored.map(f64::from)) + displacement;
    if !n.is_finite() {
        return None;
    }
    let n = (*cofactors * n).normalize_or_zero();
    (n != DVec3::ZERO).then(|| octahedral_encode(n.as_vec3()))
}

/// Checks transformed texture coordinates.
fn texcoord(mesh: &Mesh<'_>, set: u32, i: usize, stored: [f32; 2], moved: Vec2) -> Result<Vec2> {
    let inside = moved.abs().max_element() <= MAX_COORDINATE && !moved.is_nan();
    inside.then_some(moved).ok_or_else(|| {
        let expected = format_args!("finite coordinates up to {MAX_COORDINATE:e}");
        bad(mesh, format_args!("TEXCOORD_{set}"), i, &stored, expected)
    })
}

/// The encoded tangent of a vertex in world space; `None` if it has no direction.
fn tangent(
    mesh: &Mesh<'_>,
    accessor: &Accessor<'_>,
    weights: &[f32],
    matrix: &DMat4,
    i: usize,
) -> Option<u32> {
    let [x, y, z, sign] = accessor.floats::<4>(i);
    let displacement = mesh.deformation.displacement(Displaced::Tangent, weights, i);
    let local = DVec3::new(x.into(), y.into(), z.into()) + displacement;
    let world = matrix.transform_vector3(local).try_normalize()?;
    Some(tangent_encode(world.as_vec3(), (sign < 0.0) != mirrors(matrix)))
}

fn color(mesh: &Mesh<'_>, accessor: &Accessor<'_>, i: usize) -> Result<[u16; 4]> {
    let mut rgba = accessor.floats::<4>(i);
    if accessor.components == 3 {
        rgba[3] = 1.0;
    }
    if rgba.iter().any(|c| !c.is_finite()) {
        return Err(bad(mesh, format_args!("COLOR_0"), i, &rgba, format_args!("finite colours")));
    }
    Ok(rgba.map(|c| (c.clamp(0.0, 1.0) * 65535.0).round() as u16))
}

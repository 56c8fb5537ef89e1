//! Transforms a primitive's vertices into world space.

use std::ops::Range;

use glam::{DMat3, DVec3, Vec2, Vec3};

use super::accessors::Accessor;
use super::meshes::Mesh;
use super::nodes::Placed;
use super::normalized::{flushed2, flushed3};
use crate::scene::{MAX_COORDINATE, octahedral_encode, tangent_encode};
use crate::{Error, Result};

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
    pub colors: Vec<u32>,
}

impl Vertices {
    pub fn of(mesh: &Mesh<'_>, node: &Placed<'_>) -> Result<Self> {
        let used = Used::by(mesh)?;
        let positions = used.map(|i| position(mesh, node, i))?;
        let cofactors = cofactors(node);
        let normals = mesh.normals.as_ref();
        let normals = normals.map_or(Ok(Vec::new()), |a| used.map(|i| normal(mesh, a, &cofactors, i)))?;
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
        let tangents = match &mesh.tangents {
            None => Some(Vec::new()),
            Some(accessor) => used.map(|i| Ok(tangent(accessor, node, i)))?.into_iter().collect(),
        };
        let tangents = tangents.unwrap_or_default();
        let colors = mesh.colors.as_ref();
        let colors = colors.map_or(Ok(Vec::new()), |a| used.map(|i| color(mesh, a, i)))?;
        Ok(Self { used, positions, normals, texcoords, second, tangents, colors })
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

fn position(mesh: &Mesh<'_>, node: &Placed<'_>, i: usize) -> Result<Vec3> {
    let stored = mesh.positions.floats::<3>(i);
    let world = node.world.transform_point3(Vec3::from(stored).as_dvec3());
    if world.abs().max_element() <= f64::from(MAX_COORDINATE) && !world.is_nan() {
        return Ok(flushed3(world.as_vec3()));
    }
    let found = if Vec3::from(stored).is_finite() { world.to_array() } else { stored.map(f64::from) };
    let expected = format_args!("finite coordinates up to {MAX_COORDINATE:e} in the world");
    Err(bad(mesh, format_args!("POSITION"), i, &found, expected))
}

/// The cofactor matrix, which transforms normals: the inverse transpose times the determinant. It exists for
/// every matrix, and only directions matter.
fn cofactors(node: &Placed<'_>) -> DMat3 {
    let linear = DMat3::from_mat4(node.world);
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let mirror = if node.mirrors() { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror
}

fn normal(mesh: &Mesh<'_>, accessor: &Accessor<'_>, cofactors: &DMat3, i: usize) -> Result<Option<u32>> {
    let n = Vec3::from(accessor.floats::<3>(i));
    if !n.is_finite() {
        return Err(bad(mesh, format_args!("NORMAL"), i, &n.to_array(), format_args!("a finite vector")));
    }
    let n = (*cofactors * n.as_dvec3()).normalize_or_zero();
    Ok((n != DVec3::ZERO).then(|| octahedral_encode(n.as_vec3())))
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
fn tangent(accessor: &Accessor<'_>, node: &Placed<'_>, i: usize) -> Option<u32> {
    let [x, y, z, sign] = accessor.floats::<4>(i);
    let world = node.world.transform_vector3(DVec3::new(x.into(), y.into(), z.into())).try_normalize()?;
    Some(tangent_encode(world.as_vec3(), (sign < 0.0) != node.mirrors()))
}

fn color(mesh: &Mesh<'_>, accessor: &Accessor<'_>, i: usize) -> Result<u32> {
    let mut rgba = accessor.floats::<4>(i);
    if accessor.components == 3 {
        rgba[3] = 1.0;
    }
    if rgba.iter().any(|c| !c.is_finite()) {
        return Err(bad(mesh, format_args!("COLOR_0"), i, &rgba, format_args!("finite colours")));
    }
    Ok(u32::from_le_bytes(rgba.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8)))
}

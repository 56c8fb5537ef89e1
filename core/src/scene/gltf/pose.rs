//! From the transforms of nodes to the world: skins (glTF 2.0, section 3.7.3) and instances
//! (EXT_mesh_gpu_instancing).
//!
//! What a file says of a pose stays apart from the pose: [`Skin`] and [`Instancing`] are opened once and evaluated
//! for any transforms of the nodes.

use glam::{DMat3, DMat4, DQuat, DVec3};
use gltf::json;
use json::accessor::Type;

use super::accessors::{Accessor, Source};
use super::nodes::Placed;
use crate::{Error, Result};

/// What brings the vertices of one instance of a mesh into the world.
pub(super) enum Transform<'p> {
    /// One matrix for all vertices.
    Rigid(DMat4),
    /// World-space matrices of a skin's joints, of which each vertex takes a weighted mean.
    Skinned(&'p [DMat4]),
}

/// The pose of one instance of a mesh.
pub(super) struct Placement<'p> {
    pub transform: Transform<'p>,
    /// Weights of the morph targets, in their order; those that are missing are 0.
    pub weights: &'p [f32],
}

/// Whether a transform mirrors, that is, changes handedness.
pub(super) fn mirrors(matrix: &DMat4) -> bool {
    DMat3::from_mat4(*matrix).determinant() < 0.0
}

/// The cofactor matrix, which transforms normals: the inverse transpose times the determinant. It exists for
/// every matrix, and only directions matter.
pub(super) fn cofactors(matrix: &DMat4) -> DMat3 {
    let linear = DMat3::from_mat4(*matrix);
    let [x, y, z] = [linear.x_axis, linear.y_axis, linear.z_axis];
    let mirror = if mirrors(matrix) { -1.0 } else { 1.0 };
    DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y)) * mirror
}

/// Joints of a skin with their inverse bind matrices.
pub(super) struct Skin {
    /// Node and inverse bind matrix of each joint.
    joints: Vec<(usize, DMat4)>,
}

impl Skin {
    pub fn open(source: &Source<'_>, index: usize) -> Result<Self> {
        let what = format!("skin {index}");
        let root = source.root;
        let json = root
            .skins
            .get(index)
            .ok_or_else(|| Error::scene(&what, format!("no such skin; the file has {}", root.skins.len())))?;
        let matrices = json.inverse_bind_matrices.map(|accessor| {
            source.accessor(accessor.value(), &format!("{what}, inverseBindMatrices"), &[Type::Mat4])
        });
        let matrices = matrices.transpose()?;
        if let Some(found) = matrices.as_ref().map(|m| m.count).filter(|n| *n < json.joints.len()) {
            return Err(Error::scene(
                format!("{what}, inverseBindMatrices"),
                format!("expected one for each of {} joints, found {found}", json.joints.len()),
            ));
        }
        let joint = |(i, node): (usize, &json::Index<json::Node>)| {
            let matrix = matrices.as_ref().map_or(Ok(DMat4::IDENTITY), |accessor| {
                let matrix = DMat4::from_cols_array(&accessor.floats::<16>(i).map(f64::from));
                matrix.is_finite().then_some(matrix).ok_or_else(|| {
                    let what = format!("{what}, inverseBindMatrices");
                    Error::scene(what, format!("element {i}: expected finite numbers, found {matrix}"))
                })
            });
            Ok((node.value(), matrix?))
        };
        let joints = json.joints.iter().enumerate().map(joint).collect::<Result<_>>()?;
        Ok(Self { joints })
    }

    /// World-space matrices of the joints for the given pose; an error names the node of a joint that is not
    /// among the nodes shown.
    pub fn matrices(&self, pose: &Pose) -> std::result::Result<Vec<DMat4>, usize> {
        let matrix = |(node, bind): &(usize, DMat4)| Ok(pose.world(*node).ok_or(*node)? * *bind);
        self.joints.iter().map(matrix).collect()
    }
}

/// World transforms of the nodes that are shown.
pub(super) struct Pose {
    worlds: Vec<Option<DMat4>>,
}

impl Pose {
    pub fn of(placed: &[Placed<'_>], nodes: usize) -> Self {
        let mut worlds = vec![None; nodes];
        for node in placed {
            worlds[node.index] = Some(node.world);
        }
        Self { worlds }
    }

    fn world(&self, node: usize) -> Option<DMat4> {
        self.worlds.get(node).copied().flatten()
    }
}

/// Transforms of a node's instances relative to the node.
pub(super) struct Instancing<'b> {
    what: String,
    translations: Option<Accessor<'b>>,
    rotations: Option<Accessor<'b>>,
    scales: Option<Accessor<'b>>,
    /// Number of instances.
    pub count: usize,
}

impl<'b> Instancing<'b> {
    /// The instances of a node; `None` if the node does not have the extension.
    pub fn open(source: &Source<'b>, node: &Placed<'_>) -> Result<Option<Self>> {
        const NAME: &str = "EXT_mesh_gpu_instancing";
        let extension = node.json.extensions.as_ref().and_then(|e| e.others.get(NAME));
        let Some(extension) = extension else { return Ok(None) };
        let what = format!("node {}, {NAME}", node.index);
        let mut count = None;
        let mut attribute = |name: &str, shape: Type| {
            let Some(value) = extension.get("attributes").and_then(|a| a.get(name)) else { return Ok(None) };
            let what = format!("{what}, {name}");
            let index = value.as_u64().and_then(|i| usize::try_from(i).ok());
            let index = index
                .ok_or_else(|| Error::scene(&what, format!("expected an accessor's index, found {value}")))?;
            let accessor = source.accessor(index, &what, &[shape])?;
            let expected = *count.get_or_insert(accessor.count);
            if accessor.count == expected {
                return Ok(Some(accessor));
            }
            let reason =
                format!("expected {expected} elements as the other attributes, found {}", accessor.count);
            Err(Error::scene(what, reason))
        };
        let translations = attribute("TRANSLATION", Type::Vec3)?;
        let rotations = attribute("ROTATION", Type::Vec4)?;
        let scales = attribute("SCALE", Type::Vec3)?;
        let none = || Error::scene(&what, "expected TRANSLATION, ROTATION or SCALE, found none of them");
        let count = count.ok_or_else(none)?;
        Ok(Some(Self { what, translations, rotations, scales, count }))
    }

    /// The matrix of an instance, to be applied before the node's own.
    pub fn matrix(&self, i: usize) -> Result<DMat4> {
        let vector = |accessor: &Option<Accessor<'_>>, default: DVec3| {
            accessor.as_ref().map_or(default, |a| DVec3::from(a.floats::<3>(i).map(f64::from)))
        };
        let rotation = self.rotations.as_ref().map_or(DQuat::IDENTITY, |accessor| {
            DQuat::from_array(accessor.floats::<4>(i).map(f64::from)).normalize()
        });
        let scale = vector(&self.scales, DVec3::ONE);
        let translation = vector(&self.translations, DVec3::ZERO);
        let matrix = DMat4::from_scale_rotation_translation(scale, rotation, translation);
        matrix.is_finite().then_some(matrix).ok_or_else(|| {
            Error::scene(
                &self.what,
                format!(
                    "instance {i}: expected a finite transform, found {translation}, {rotation}, {scale}"
                ),
            )
        })
    }
}

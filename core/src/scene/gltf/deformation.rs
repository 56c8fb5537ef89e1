//! What deforms a mesh primitive: morph targets, and joints with weights (glTF 2.0, sections 3.7.2.2 and 3.7.3.3).

use glam::{DMat4, DVec3};
use gltf::json;
use json::accessor::Type;
use json::mesh::{Primitive, Semantic};

use super::accessors::{Accessor, Source};
use super::attributes::Attributes;
use crate::{Error, Result};

/// Displacements of one morph target.
struct Target<'b> {
    positions: Option<Accessor<'b>>,
    normals: Option<Accessor<'b>>,
    tangents: Option<Accessor<'b>>,
}

/// An attribute that morph targets displace.
#[derive(Clone, Copy)]
pub(super) enum Displaced {
    Position,
    Normal,
    Tangent,
}

/// One set of four joints and weights for each vertex, JOINTS_n and WEIGHTS_n.
struct Influences<'b> {
    joints: Accessor<'b>,
    weights: Accessor<'b>,
}

/// The morph targets and the joints of a primitive, opened as its instances need them.
#[derive(Default)]
pub(super) struct Deformation<'b> {
    /// Targets by their index; `None` until an instance weights them.
    targets: Vec<Option<Target<'b>>>,
    influences: Vec<Influences<'b>>,
}

/// A vertex's mean of the joints' matrices.
pub(super) struct Blend {
    pub matrix: DMat4,
    /// Sum of the weights before they were normalised.
    pub sum: f64,
}

impl<'b> Deformation<'b> {
    /// Opens the targets whose weight is not 0 and, for a skinned instance, the joints, for a primitive of
    /// `vertices` vertices. Returns the number of targets and sets of joints that apply to each vertex.
    pub fn open(
        &mut self,
        source: &Source<'b>,
        primitive: &Primitive,
        what: &str,
        vertices: usize,
        skinned: bool,
        weights: &[f32],
    ) -> Result<usize> {
        let counted = |accessor: Accessor<'b>, what: &str| {
            if accessor.count == vertices {
                return Ok(accessor);
            }
            let reason = format!("expected {vertices} elements as POSITION has, found {}", accessor.count);
            Err(Error::scene(what, reason))
        };
        let targets = primitive.targets.as_deref().unwrap_or_default();
        let mut layers = 0;
        for (i, (target, _)) in targets.iter().zip(weights).enumerate().filter(|(_, (_, w))| **w != 0.0) {
            layers += 1;
            if self.targets.get(i).is_some_and(Option::is_some) {
                continue;
            }
            let displacement = |index: Option<json::Index<json::Accessor>>, name: &str| {
                let what = format!("{what}, {name} of target {i}");
                let open =
                    |i: json::Index<_>| counted(source.accessor(i.value(), &what, &[Type::Vec3])?, &what);
                index.map(open).transpose()
            };
            let positions = displacement(target.positions, "POSITION")?;
            let normals = displacement(target.normals, "NORMAL")?;
            let tangents = displacement(target.tangents, "TANGENT")?;
            if self.targets.len() <= i {
                self.targets.resize_with(i + 1, || None);
            }
            self.targets[i] = Some(Target { positions, normals, tangents });
        }
        if !skinned {
            return Ok(layers);
        }
        if self.influences.is_empty() {
            let attributes = Attributes::of(source, primitive, what)?;
            let attribute = |semantic: Semantic| {
                let what = format!("{what}, {}", semantic.to_string());
                attributes.get(semantic, &[Type::Vec4])?.map(|a| counted(a, &what)).transpose()
            };
            for n in 0.. {
                let Some(joints) = attribute(Semantic::Joints(n))? else { break };
                if !joints.is_unsigned() {
                    let what = format!("{what}, JOINTS_{n}");
                    return Err(Error::scene(
                        what,
                        "expected unsigned integers, found another component type",
                    ));
                }
                let weights = attribute(Semantic::Weights(n))?.ok_or_else(|| {
                    Error::scene(
                        format!("{what}, JOINTS_{n}"),
                        format!("expected WEIGHTS_{n} with it, found none"),
                    )
                })?;
                self.influences.push(Influences { joints, weights });
            }
        }
        Ok(layers + self.influences.len())
    }

    /// Whether vertices have joints.
    pub fn is_skinned(&self) -> bool {
        !self.influences.is_empty()
    }

    /// What the targets add to an attribute of a vertex.
    pub fn displacement(&self, attribute: Displaced, weights: &[f32], vertex: usize) -> DVec3 {
        let accessor = |target: &'_ Option<Target<'b>>| -> Option<[f32; 3]> {
            let target = target.as_ref()?;
            let accessor = match attribute {
                Displaced::Position => &target.positions,
                Displaced::Normal => &target.normals,
                Displaced::Tangent => &target.tangents,
            };
            Some(accessor.as_ref()?.floats(vertex))
        };
        let weighted = self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0);
        weighted
            .filter_map(|(target, weight)| Some((accessor(target)?, *weight)))
            .map(|(delta, weight)| DVec3::from(delta.map(f64::from)) * f64::from(weight))
            .sum()
    }

    /// The mean of `joints` by a vertex's weights; that of its first joint where all weights are 0.
    pub fn blend(&self, what: &str, joints: &[DMat4], vertex: usize) -> Result<Blend> {
        let joint = |n: usize, index: u32| {
            joints.get(index as usize).ok_or_else(|| {
                Error::scene(
                    format!("{what}, JOINTS_{n}"),
                    format!("element {vertex}: expected one of {} joints, found {index}", joints.len()),
                )
            })
        };
        let (mut matrix, mut sum) = (DMat4::ZERO, 0.0);
        for (n, set) in self.influences.iter().enumerate() {
            let (indices, weights) = (set.joints.integers::<4>(vertex), set.weights.floats::<4>(vertex));
            if !weights.iter().all(|w| w.is_finite() && *w >= 0.0) {
                return Err(Error::scene(
                    format!("{what}, WEIGHTS_{n}"),
                    format!("element {vertex}: expected finite numbers from 0 on, found {weights:?}"),
                ));
            }
            for (index, weight) in indices.into_iter().zip(weights).filter(|(_, weight)| *weight > 0.0) {
                matrix += *joint(n, index)? * f64::from(weight);
                sum += f64::from(weight);
            }
        }
        let first = self.influences.first().filter(|_| sum == 0.0);
        let matrix = match first {
            Some(set) => *joint(0, set.joints.integers::<1>(vertex)[0])?,
            None => matrix / sum,
        };
        Ok(Blend { matrix, sum })
    }
}

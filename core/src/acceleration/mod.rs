//! The acceleration structure: an eight-wide compressed BVH (Ylitie, Karras & Laine 2017) over triangles and
//! spheres.
//!
//! ```text
//! boxes --cluster--> binary tree --reinsertion, 16 times--> --obvhs--> wide tree --quantise--> nodes
//!                         +-- depth: no path is longer than DEPTH_LIMIT, before each step
//! ```
//!
//! Guarantees for every input: each decoded box contains its primitives in exact arithmetic ([`quantise`]), no
//! path is longer than [`depth::DEPTH_LIMIT`], and the traversal stack cannot overflow.

mod cluster;
mod depth;
mod quantise;
#[cfg(test)]
mod tests;

pub use depth::DEPTH_LIMIT;
use glam::Vec3A;
use obvhs::{
    aabb::Aabb,
    bvh2::reinsertion::ReinsertionOptimizer,
    cwbvh::{bvh2_to_cwbvh::bvh2_to_cwbvh, node::CwBvhNode},
};

use crate::scene::{Scene, Sphere};

/// The nodes of the BVH, and the primitives in the order of its leaves. Primitives with an index below the number
/// of triangles are triangles, the others spheres.
pub struct Bvh {
    /// Compressed eight-wide nodes of 80 bytes (Ylitie et al. 2017, section 3).
    pub nodes: Vec<CwBvhNode>,
    /// Index in the scene of the primitive at position `i` of the leaves.
    pub order: Vec<u32>,
    /// The most node groups on the traversal stack.
    pub stack: u32,
}

impl Bvh {
    /// Builds the BVH over all primitives of a scene.
    #[must_use]
    pub fn build(scene: &Scene) -> Self {
        let triangles = scene.positions.iter().map(|corners| {
            let [a, b, c] = corners.map(Vec3A::from);
            Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
        });
        Self::of_boxes(&triangles.chain(scene.spheres.iter().map(sphere_bounds)).collect::<Vec<_>>())
    }

    /// Builds the BVH over boxes, which are identified by their indices.
    #[must_use]
    pub fn of_boxes(boxes: &[Aabb]) -> Self {
        let mut tree = cluster::cluster(&in_sane_units(boxes));
        let mut optimizer = ReinsertionOptimizer::default();
        // Reinsertion tries all nodes first, then fewer and fewer of the largest: tree quality matters more than
        // node layout.
        for divisor in (1..32).step_by(2) {
            tree.max_depth = depth::limit(&mut tree) as usize;
            optimizer.run(&mut tree, 1.0, Some(vec![1.0 / divisor as f32]));
        }
        depth::limit(&mut tree);
        let wide = bvh2_to_cwbvh(&tree, PRIMITIVES_PER_LEAF, true, false);
        let (mut nodes, order) = (wide.nodes, wide.primitive_indices);
        quantise::quantise(&mut nodes, &order, boxes);
        let stack = stack_bound(&nodes);
        Self { nodes, order, stack }
    }
}

/// The most primitives per leaf, from the node format.
const PRIMITIVES_PER_LEAF: u32 = 3;

/// The bounding box of a sphere, rounded outwards.
fn sphere_bounds(sphere: &Sphere) -> Aabb {
    let center = Vec3A::from(sphere.center);
    Aabb {
        min: (center - sphere.radius).map(f32::next_down),
        max: (center + sphere.radius).map(f32::next_up),
    }
}

/// Scales the boxes by a power of two, so that areas do not overflow and those of visible size do not underflow.
/// Only the tree's topology depends on them.
fn in_sane_units(boxes: &[Aabb]) -> Vec<Aabb> {
    const LARGEST: f64 = 1_048_576.0;
    let largest = boxes.iter().map(|b| b.min.abs().max(b.max.abs()).max_element()).fold(0.0, f32::max);
    if largest == 0.0 {
        return boxes.to_vec();
    }
    let factor = (LARGEST / f64::from(largest)).log2().floor().exp2();
    let scaled = |v: Vec3A| v.map(|x| (f64::from(x) * factor) as f32);
    boxes.iter().map(|b| Aabb { min: scaled(b.min), max: scaled(b.max) }).collect()
}

/// The range of a node's children that are inner nodes.
fn inner_children(node: &CwBvhNode) -> std::ops::Range<usize> {
    let first = node.child_base_idx as usize;
    first..first + node.imask.count_ones() as usize
}

/// Upper bound of the traversal stack: each node on a path leaves at most one group.
pub const MAX_STACK: u32 = DEPTH_LIMIT;

/// The stack size that a tree needs. A visit leaves the group of a node's other inner children on the stack while
/// it descends into one, in an order that depends on the ray; the last one leaves nothing.
fn stack_bound(nodes: &[CwBvhNode]) -> u32 {
    let mut bounds = vec![0; nodes.len()];
    // Children have larger indices than their parents.
    for (index, node) in nodes.iter().enumerate().rev() {
        let children = inner_children(node);
        let left = u32::from(children.len() > 1);
        bounds[index] = bounds[children].iter().max().map_or(0, |deepest| deepest + left);
    }
    // WGSL has no empty arrays, so the stack has at least one entry.
    bounds.first().map_or(1, |&bound| bound.max(1))
}

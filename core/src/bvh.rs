//! The acceleration structure: an eight-wide compressed BVH (Ylitie, Karras, Laine 2017) over triangles and
//! spheres, built by obvhs (PLOC, then reinsertion over all nodes: tree quality pays more than layout).

use glam::Vec3A;
use obvhs::{
    BvhBuildParams,
    aabb::Aabb,
    cwbvh::{CwBvh, builder::build_cwbvh, node::CwBvhNode},
};

use crate::scene::Scene;

/// Nodes, and the primitives in the order of their leaves. Primitives below the number of triangles are
/// triangles, the others spheres.
pub struct Bvh {
    /// 80 bytes each.
    pub nodes: Vec<CwBvhNode>,
    /// Primitive `order[i]` of the scene stands at place `i`.
    pub order: Vec<u32>,
    /// The most groups that wait on the traversal's stack.
    pub stack: u32,
}

impl Bvh {
    /// Builds the structure over everything in the scene.
    #[must_use]
    pub fn build(scene: &Scene) -> Self {
        let triangles = scene.positions.iter().map(|corners| {
            let [a, b, c] = corners.map(Vec3A::from);
            Aabb { min: a.min(b).min(c), max: a.max(b).max(c) }
        });
        let spheres = scene.spheres.iter().map(|s| {
            let center = Vec3A::from(s.center);
            Aabb { min: center - s.radius, max: center + s.radius }
        });
        let boxes: Vec<Aabb> = triangles.chain(spheres).collect();
        let parameters = BvhBuildParams { reinsertion_batch_ratio: 1.0, ..BvhBuildParams::medium_build() };
        let tree = build_cwbvh(&boxes, parameters, &mut Default::default());
        let stack = stack_bound(&tree);
        Self { nodes: tree.nodes, order: tree.primitive_indices, stack }
    }
}

/// Every level of the tree leaves at most one group of siblings on the stack, so its depth bounds the stack.
fn stack_bound(tree: &CwBvh) -> u32 {
    let mut deepest = 1;
    let mut pending = vec![(0_usize, 1_u32)];
    while let Some((index, depth)) = pending.pop() {
        deepest = deepest.max(depth);
        if let Some(node) = tree.nodes.get(index) {
            let children = node.imask.count_ones() as usize;
            pending.extend((0..children).map(|i| (node.child_base_idx as usize + i, depth + 1)));
        }
    }
    deepest
}

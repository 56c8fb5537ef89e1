//! Parallel locally-ordered clustering (Meister & Bittner 2018): boxes along a Morton curve merge in rounds if
//! each is the other's best partner.
//!
//! If costs tie (coincident boxes, boxes without area) or decrease monotonically along the curve, a round may
//! find a single pair, and the work would be quadratic. Such a round merges neighbours on the curve instead, so
//! that every round removes a minimum share of the boxes and the work is O(n log n).

use glam::{DVec3, Vec3A};
use obvhs::{
    aabb::Aabb,
    bvh2::{Bvh2, node::Bvh2Node},
    ploc::morton::morton_encode_u64_unorm,
};

/// Search radius for partners, in boxes along the curve.
const REACH: usize = 14;
/// Number of first rounds that only consider the next box, which is as good there and cheaper.
const SHORT_ROUNDS: u32 = 3;
/// Divisor of the least share of the boxes that a round must remove. In ordinary scenes rounds remove a quarter
/// and more.
const LEAST_SHARE: usize = 16;

/// Builds a binary tree over the boxes with one box per leaf.
pub fn cluster(boxes: &[Aabb]) -> Bvh2 {
    let mut current = along_a_curve(boxes);
    let mut tree = Bvh2::zeroed(boxes.len());
    tree.primitive_indices = (0..boxes.len() as u32).collect();
    let mut free = tree.nodes.len();
    let mut round = 0;
    while current.len() > 1 {
        let mut partners = best_partners(&current, if round < SHORT_ROUNDS { 1 } else { REACH });
        let agreed = (0..current.len()).filter(|&i| partners[partners[i]] == i).count() / 2;
        if agreed * LEAST_SHARE < current.len() {
            let last = current.len() - 1;
            partners = (0..current.len()).map(|i| (i ^ 1).min(last)).collect();
        }
        let mut next = Vec::with_capacity(current.len());
        for (index, &partner) in partners.iter().enumerate() {
            if partners[partner] != index || partner == index {
                next.push(current[index]);
            } else if partner < index {
                free -= 2;
                let (left, right) = (current[index], current[partner]);
                tree.nodes[free] = left;
                tree.nodes[free + 1] = right;
                next.push(Bvh2Node::new(left.aabb().union(right.aabb()), 0, free as u32));
            }
        }
        current = next;
        round += 1;
    }
    if let Some(root) = current.first() {
        tree.nodes[0] = *root;
    }
    tree
}

fn along_a_curve(boxes: &[Aabb]) -> Vec<Bvh2Node> {
    let center = |b: &Aabb| 0.5 * (b.min.as_dvec3() + b.max.as_dvec3());
    let low = boxes.iter().map(center).fold(DVec3::INFINITY, DVec3::min);
    let size = boxes.iter().map(center).fold(DVec3::NEG_INFINITY, DVec3::max) - low;
    // Slightly below the full scale, as the Morton code of 1 would wrap around to that of 0.
    let scale = size.map(|s| if s > 0.0 { (1.0 - f64::EPSILON) / s } else { 0.0 });
    let mut order: Vec<(u64, u32)> = boxes
        .iter()
        .zip(0..)
        .map(|(b, index)| (morton_encode_u64_unorm((center(b) - low) * scale), index))
        .collect();
    order.sort_unstable();
    order.iter().map(|&(_, index)| Bvh2Node::new(boxes[index as usize], 1, index)).collect()
}

/// For each box the partner within reach whose union has the least area; among equals the last.
fn best_partners(current: &[Bvh2Node], reach: usize) -> Vec<usize> {
    let mut best = vec![(f32::INFINITY, 0); current.len()];
    for (i, node) in current.iter().enumerate() {
        for (j, other) in current.iter().enumerate().skip(i + 1).take(reach) {
            let area = half_area(node.aabb(), other.aabb());
            if area <= best[i].0 {
                best[i] = (area, j);
            }
            if area <= best[j].0 {
                best[j] = (area, i);
            }
        }
    }
    best.into_iter().map(|(_, partner)| partner).collect()
}

fn half_area(a: &Aabb, b: &Aabb) -> f32 {
    let size: Vec3A = a.max.max(b.max) - a.min.min(b.min);
    size.x * size.y + size.y * size.z + size.z * size.x
}

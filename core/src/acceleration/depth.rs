//! Limits the depth of the tree for any input: clustering and reinsertion can make it as deep as it has leaves
//! (for nested boxes a chain is best), and code that walks the tree recurses along its paths.

use std::cmp::Ordering;

use glam::Vec3A;
use obvhs::{
    aabb::Aabb,
    bvh2::{Bvh2, node::Bvh2Node},
};

/// The most nodes on a path from the root to a leaf. Trees of ordinary scenes have 25 to 45; 2^32 leaves fit into
/// 33.
pub const DEPTH_LIMIT: u32 = 64;

/// Rebuilds the smallest subtrees that exceed [`DEPTH_LIMIT`], split at the median. Returns the depth of the
/// tree.
pub fn limit(tree: &mut Bvh2) -> u32 {
    if tree.nodes.is_empty() {
        return 0;
    }
    let subtrees = measure(tree);
    let height = subtrees[0].height;
    if height <= DEPTH_LIMIT {
        return height;
    }
    let mut pending = vec![(0_usize, DEPTH_LIMIT)];
    while let Some((index, room)) = pending.pop() {
        if subtrees[index].height <= room {
            continue;
        }
        let first = tree.nodes[index].first_index as usize;
        if subtrees[first..first + 2].iter().all(|child| child.least_height() < room) {
            pending.extend([(first, room - 1), (first + 1, room - 1)]);
        } else {
            balance(tree, index);
        }
    }
    tree.parents.clear();
    tree.children_are_ordered_after_parents = false;
    DEPTH_LIMIT
}

#[derive(Clone, Copy, Default)]
struct Subtree {
    /// Nodes on the longest path from this node to a leaf.
    height: u32,
    leaves: u32,
}

impl Subtree {
    /// The height of a balanced tree with as many leaves.
    fn least_height(self) -> u32 {
        1 + self.leaves.next_power_of_two().ilog2()
    }
}

fn measure(tree: &Bvh2) -> Vec<Subtree> {
    let mut order = vec![0_usize];
    let mut next = 0;
    while let Some(&index) = order.get(next) {
        next += 1;
        let node = &tree.nodes[index];
        if !node.is_leaf() {
            order.extend([node.first_index as usize, node.first_index as usize + 1]);
        }
    }
    let mut subtrees = vec![Subtree { height: 1, leaves: 1 }; tree.nodes.len()];
    for index in order.into_iter().rev() {
        let node = &tree.nodes[index];
        if !node.is_leaf() {
            let (a, b) = (subtrees[node.first_index as usize], subtrees[node.first_index as usize + 1]);
            subtrees[index] = Subtree { height: 1 + a.height.max(b.height), leaves: a.leaves + b.leaves };
        }
    }
    subtrees
}

/// Rebuilds a subtree in its own nodes, split in halves along the longest side of the centres' box.
fn balance(tree: &mut Bvh2, root: usize) {
    let (mut leaves, mut pairs, mut pending) = (Vec::new(), Vec::new(), vec![root]);
    while let Some(index) = pending.pop() {
        let node = tree.nodes[index];
        if node.is_leaf() {
            leaves.push(node);
        } else {
            pairs.push(node.first_index);
            pending.extend([node.first_index as usize, node.first_index as usize + 1]);
        }
    }
    let mut pending = vec![(root, 0..leaves.len())];
    while let Some((index, range)) = pending.pop() {
        let part = &mut leaves[range.clone()];
        if let [leaf] = part {
            tree.nodes[index] = *leaf;
        } else if let Some(pair) = pairs.pop() {
            let bounds = part.iter().map(|n| *n.aabb()).reduce(|a, b| a.union(&b)).unwrap_or(Aabb::empty());
            let half = part.len() / 2;
            part.select_nth_unstable_by(half, along_longest_side(part));
            tree.nodes[index] = Bvh2Node::new(bounds, 0, pair);
            let middle = range.start + half;
            pending.extend([(pair as usize, range.start..middle), (pair as usize + 1, middle..range.end)]);
        }
    }
}

fn along_longest_side(leaves: &[Bvh2Node]) -> impl Fn(&Bvh2Node, &Bvh2Node) -> Ordering + use<> {
    let center = |node: &Bvh2Node| 0.5 * node.aabb().min + 0.5 * node.aabb().max;
    let low = leaves.iter().map(center).fold(Vec3A::INFINITY, Vec3A::min);
    let high = leaves.iter().map(center).fold(Vec3A::NEG_INFINITY, Vec3A::max);
    let axis = (high - low).max_position();
    move |a, b| center(a)[axis].total_cmp(&center(b)[axis])
}

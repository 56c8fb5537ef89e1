//! Tests of the tree with degenerate, huge and coincident boxes.

use glam::{Vec3A, vec3a};
use obvhs::{aabb::Aabb, bvh2::Bvh2};

use super::{Bvh, cluster::cluster, depth, inner_children, quantise};
use crate::random::Random;

fn point(p: Vec3A) -> Aabb {
    Aabb { min: p, max: p }
}

fn random_point(random: &mut Random, size: f32) -> Vec3A {
    let mut next = || (2.0 * random.unit() - 1.0) as f32;
    size * vec3a(next(), next(), next())
}

fn random_boxes(count: usize, place: f32, size: f32, offset: Vec3A) -> Vec<Aabb> {
    let mut random = Random(7);
    let mut corner = |size| random_point(&mut random, size);
    let boxes = (0..count).map(|_| {
        let (at, a, b) = (offset + corner(place), corner(size), corner(size));
        Aabb { min: at + a.min(b), max: at + a.max(b) }
    });
    boxes.collect()
}

fn hostile() -> Vec<(&'static str, Vec<Aabb>)> {
    let mut random = Random(3);
    let powers = |base: f32| (0..250).map(move |i| base.powi(i - 125));
    let coincident = point(vec3a(1.0, 2.0, 3.0));
    let triangle = Aabb { min: Vec3A::ZERO, max: vec3a(1.0, 1.0, 0.0) };
    vec![
        ("one point", vec![coincident]),
        ("two points", vec![coincident, point(Vec3A::ZERO)]),
        ("random", random_boxes(3000, 1.0, 0.1, Vec3A::ZERO)),
        ("far", random_boxes(3000, 1.0, 0.1, vec3a(1e7, -3e6, 16_777_216.0))),
        ("small and far", random_boxes(3000, 1e-3, 1e-4, Vec3A::splat(1e6))),
        ("denormal", random_boxes(3000, 1e-40, 1e-41, Vec3A::ZERO)),
        ("tiny", random_boxes(3000, 1e-36, 1e-37, Vec3A::ZERO)),
        ("huge", random_boxes(3000, 1e18, 1e18, Vec3A::ZERO)),
        (
            "mixed",
            [1e-40, 1e-30, 1e-6, 1.0, 1e6, 1e18].map(|s| random_boxes(500, s, s, Vec3A::ZERO)).concat(),
        ),
        // The distance from the origin to the second box rounds to a whole number of quantisation units.
        (
            "a speck in the middle",
            vec![
                point(Vec3A::splat(-(2_f32.powi(59)))),
                Aabb { min: Vec3A::splat(-(2_f32.powi(-20))), max: Vec3A::splat(2_f32.powi(-20)) },
                point(Vec3A::splat(2_f32.powi(58))),
            ],
        ),
        ("planar", (0..3000).map(|_| point(random_point(&mut random, 1.0) * vec3a(1.0, 0.0, 1.0))).collect()),
        ("on a line", (0..3000).map(|i| point(vec3a(1.0, i as f32 * 0.3, -7.0))).collect()),
        ("coincident points", vec![coincident; 3000]),
        ("coincident triangles", vec![triangle; 3000]),
        ("nested", powers(1.4).map(|s| Aabb { min: Vec3A::splat(-s), max: Vec3A::splat(s) }).collect()),
        ("exponentially spaced", powers(1.3).map(|s| point(Vec3A::splat(s))).collect()),
        ("squares", (0..3000).map(|i| point(vec3a((i * i) as f32, 0.0, (i * i) as f32))).collect()),
    ]
}

/// Whether `p + q 2^e` is at most (for a negative `sign`, at least) `x` in exact arithmetic.
fn beside(p: f32, q: u8, exponent: u8, x: f32, sign: f64) -> bool {
    let (p, plane) = (f64::from(p), f64::from(q) * quantise::unit(exponent));
    // The rounded sum and its rounding error (Dekker), the larger addend first.
    let (large, small) = if p.abs() >= plane { (p, plane) } else { (plane, p) };
    let sum = large + small;
    let error = small - (sum - large);
    let over = sign * (sum - f64::from(x));
    over < 0.0 || (over == 0.0 && sign * error <= 0.0)
}

#[test]
fn no_plane_cuts_off_anything() {
    for (name, boxes) in hostile() {
        let bvh = Bvh::of_boxes(&boxes);
        let mut bounds = vec![Aabb::empty(); bvh.nodes.len()];
        for (index, node) in bvh.nodes.iter().enumerate().rev() {
            let children = quantise::child_boxes(node, &bounds, &bvh.order, &boxes);
            for (slot, child) in children.iter().enumerate() {
                let Some(child) = child else { continue };
                bounds[index] = bounds[index].union(child);
                let low = [node.child_min_x[slot], node.child_min_y[slot], node.child_min_z[slot]];
                let high = [node.child_max_x[slot], node.child_max_y[slot], node.child_max_z[slot]];
                for axis in 0..3 {
                    let (p, e) = (node.p[axis], node.e[axis]);
                    let holds = beside(p, low[axis], e, child.min[axis], 1.0)
                        && beside(p, high[axis], e, child.max[axis], -1.0);
                    assert!(holds, "{name}: node {index}, slot {slot}, axis {axis}: {node:?} {child:?}");
                }
            }
        }
    }
}

/// Every primitive must be in exactly one leaf, and every node except the root must have exactly one parent.
#[test]
fn nothing_is_lost() {
    for (name, boxes) in hostile() {
        let bvh = Bvh::of_boxes(&boxes);
        let mut order = bvh.order.clone();
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..boxes.len() as u32), "{name}");
        let mut children: Vec<_> = bvh.nodes.iter().flat_map(inner_children).collect();
        children.sort_unstable();
        assert!(children.into_iter().eq(1..bvh.nodes.len()), "{name}");
        assert!(bvh.stack <= depth::DEPTH_LIMIT, "{name}: {}", bvh.stack);
    }
}

fn depth_of(tree: &Bvh2) -> u32 {
    let mut deepest = 0;
    let mut pending = vec![(0, 1)];
    while let Some((index, depth)) = pending.pop() {
        let node = &tree.nodes[index];
        deepest = deepest.max(depth);
        if !node.is_leaf() {
            pending
                .extend([(node.first_index as usize, depth + 1), (node.first_index as usize + 1, depth + 1)]);
        }
    }
    deepest
}

/// A chain: every inner node has a leaf and the rest of the tree as children.
fn chain(boxes: &[Aabb]) -> Bvh2 {
    let mut tree = cluster(boxes);
    let leaves: Vec<_> = tree.nodes.iter().filter(|n| n.is_leaf()).copied().collect();
    let mut rest = leaves[0];
    let mut free = tree.nodes.len();
    for leaf in &leaves[1..] {
        free -= 2;
        tree.nodes[free] = rest;
        tree.nodes[free + 1] = *leaf;
        let bounds = rest.aabb().union(leaf.aabb());
        rest = obvhs::bvh2::node::Bvh2Node::new(bounds, 0, free as u32);
    }
    tree.nodes[0] = rest;
    tree
}

#[test]
fn a_chain_is_cut_short() {
    let boxes = random_boxes(100_000, 1.0, 0.01, Vec3A::ZERO);
    let mut tree = chain(&boxes);
    assert_eq!(depth_of(&tree), 100_000);
    assert_eq!(depth::limit(&mut tree), depth::DEPTH_LIMIT);
    assert!(depth_of(&tree) <= depth::DEPTH_LIMIT);
    tree.validate(&boxes, false, false);
    let mut found: Vec<_> = tree.nodes.iter().filter(|n| n.is_leaf()).map(|n| n.first_index).collect();
    found.sort_unstable();
    assert!(found.into_iter().eq(0..100_000));
}

#[test]
fn a_shallow_tree_is_left_alone() {
    let mut tree = cluster(&random_boxes(10_000, 1.0, 0.01, Vec3A::ZERO));
    let before = tree.clone();
    assert_eq!(depth::limit(&mut tree), depth_of(&tree));
    assert!(bytemuck::cast_slice::<_, u8>(&tree.nodes) == bytemuck::cast_slice::<_, u8>(&before.nodes));
}

/// With one pair per round this would take 10^11 steps.
#[test]
fn a_million_coincident_boxes_end() {
    let triangle = Aabb { min: Vec3A::ZERO, max: vec3a(1.0, 1.0, 0.0) };
    let bvh = Bvh::of_boxes(&vec![triangle; 1 << 20]);
    assert_eq!(bvh.order.len(), 1 << 20);
    assert!(bvh.stack <= depth::DEPTH_LIMIT, "{}", bvh.stack);
}

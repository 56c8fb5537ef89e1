//! Quantises the boxes of a wide tree to 8 bits per plane, conservatively: a decoded plane `p + q 2^e`, in exact
//! arithmetic, lies at or outside the box. Boxes are computed from the primitives upwards, not taken from the
//! binary tree.

use obvhs::{aabb::Aabb, cwbvh::node::CwBvhNode};

use super::inner_children;

/// Sets origin, exponents and planes of every node; `order[i]` is the index of the primitive at position `i` of
/// the leaves.
pub fn quantise(nodes: &mut [CwBvhNode], order: &[u32], boxes: &[Aabb]) {
    let mut bounds = vec![Aabb::empty(); nodes.len()];
    // Children have larger indices than their parents.
    for (index, node) in nodes.iter_mut().enumerate().rev() {
        let children = child_boxes(node, &bounds, order, boxes);
        let whole = children.iter().flatten().fold(Aabb::empty(), |a, b| a.union(b));
        bounds[index] = whole;
        for axis in 0..3 {
            set_axis(node, axis, &whole, &children);
        }
    }
}

/// The boxes of a node's children by slot; `None` for empty slots.
pub fn child_boxes(node: &CwBvhNode, inner: &[Aabb], order: &[u32], boxes: &[Aabb]) -> [Option<Aabb>; 8] {
    let mut children = inner_children(node);
    std::array::from_fn(|slot| {
        let meta = node.child_meta[slot];
        if node.imask >> slot & 1 != 0 {
            return children.next().map(|child| inner[child]);
        }
        let first = node.primitive_base_idx as usize + usize::from(meta & 0x1f);
        let places = first..first + (meta >> 5).count_ones() as usize;
        order[places].iter().map(|&primitive| boxes[primitive as usize]).reduce(|a, b| a.union(&b))
    })
}

fn set_axis(node: &mut CwBvhNode, axis: usize, whole: &Aabb, children: &[Option<Aabb>; 8]) {
    let origin = without_denormals(whole.min[axis]);
    let exponent = exponent(upwards(whole.max[axis], origin));
    node.p[axis] = origin;
    node.e[axis] = exponent;
    let (low, high) = match axis {
        0 => (&mut node.child_min_x, &mut node.child_max_x),
        1 => (&mut node.child_min_y, &mut node.child_max_y),
        _ => (&mut node.child_min_z, &mut node.child_max_z),
    };
    for (slot, child) in children.iter().enumerate() {
        if let Some(child) = child {
            // In 0 to 255, as the child lies inside the node's box.
            low[slot] = (downwards(child.min[axis], origin) / unit(exponent)).floor() as u8;
            high[slot] = (upwards(child.max[axis], origin) / unit(exponent)).ceil() as u8;
        }
    }
}

/// `2^e` as the shaders decode it from a byte.
pub fn unit(exponent: u8) -> f64 {
    f64::from(f32::from_bits(u32::from(exponent) << 23))
}

/// The least exponent for which 255 units span `size`. Its unit is not subnormal, as devices may read such as
/// zero.
fn exponent(size: f64) -> u8 {
    let guess = (size / 255.0).log2().ceil() + 127.0;
    let least = (guess - 1.0).clamp(1.0, 254.0) as u8;
    (least..254).find(|&e| 255.0 * unit(e) >= size).unwrap_or(254)
}

/// The nearest number at or below `x` that is not subnormal, as devices may read those as zero.
fn without_denormals(x: f32) -> f32 {
    if !x.is_subnormal() {
        x
    } else if x > 0.0 {
        0.0
    } else {
        -f32::MIN_POSITIVE
    }
}

/// `a - b` in f64, rounded towards minus infinity.
pub fn downwards(a: f32, b: f32) -> f64 {
    let (difference, error) = difference(a, b);
    if error < 0.0 { difference.next_down() } else { difference }
}

/// `a - b` in f64, rounded towards plus infinity.
pub fn upwards(a: f32, b: f32) -> f64 {
    let (difference, error) = difference(a, b);
    if error > 0.0 { difference.next_up() } else { difference }
}

/// `a - b` rounded, and the rounding error (Knuth's TwoSum; exact).
fn difference(a: f32, b: f32) -> (f64, f64) {
    let (a, b) = (f64::from(a), -f64::from(b));
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

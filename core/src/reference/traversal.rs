//! Nearest hits in f64 on the CPU, with a median-split tree of boxes or by testing every primitive.

use std::ops::Range;

use glam::DVec3;

use super::{
    intersection::{Intersection, Primitive, Ray, Shape},
    wide::Wide,
};
use crate::Scene;

/// Allowance for a few f32 roundings, relative.
pub(super) const TRAVERSAL_ULPS: f64 = 8.0;
const ROUNDING: f64 = TRAVERSAL_ULPS * f32::EPSILON as f64;

/// The nearest intersection of a ray with the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// OID of the object.
    pub object: u32,
    /// Ray parameter of the hit.
    pub t: f64,
}

#[derive(Clone, Copy)]
struct Box3 {
    low: DVec3,
    high: DVec3,
}

enum Node {
    Inner { bounds: Box3, right: usize },
    Leaf { bounds: Box3, items: Range<usize> },
}

/// The primitives of a scene with a tree for traversal.
pub struct Tracer {
    pub(super) primitives: Vec<Primitive>,
    nodes: Vec<Node>,
    wide: Option<Wide>,
}

impl Tracer {
    /// Builds the tree over a scene's primitives, without materials: holes cut by alpha are not considered.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let triangles = scene.positions.iter().zip(&scene.triangle_objects).map(|(corners, &object)| {
            let [a, b, c] = corners.map(|p| p.as_dvec3());
            (Shape::Triangle { corner: a, e1: b - a, e2: c - a }, object)
        });
        let spheres = scene
            .spheres
            .iter()
            .map(|s| (Shape::Sphere { center: s.center.as_dvec3(), radius: f64::from(s.radius) }, s.object));
        let primitives = triangles.chain(spheres).enumerate();
        let mut boxed: Vec<(Box3, Primitive)> = primitives
            .map(|(index, (shape, object))| Primitive { shape, object, index })
            .map(|p| (Box3::of(&p), p))
            .collect();
        let mut nodes = Vec::new();
        let count = boxed.len();
        build(&mut nodes, &mut boxed, 0..count);
        Self { primitives: boxed.into_iter().map(|(_, p)| p).collect(), nodes, wide: None }
    }

    /// Traces faster with a tree like the shaders'.
    #[must_use]
    pub fn with_wide_tree(self) -> Self {
        Self { wide: Wide::new(&self.primitives), ..self }
    }

    /// The nearest hit, found with the tree.
    #[must_use]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.first(ray, None, |_| true).map(|c| Hit { object: c.object, t: c.t })
    }

    /// The nearest hit, found by testing every primitive; verifies the tree.
    #[must_use]
    pub fn nearest_of_all(&self, ray: &Ray) -> Option<Hit> {
        self.intersections(ray, None).first().map(|c| Hit { object: c.object, t: c.t })
    }

    /// The nearest accepted intersection of a ray that starts on the primitive `left`, if on any.
    #[must_use]
    pub fn first(
        &self,
        ray: &Ray,
        left: Option<usize>,
        counts: impl Fn(&Intersection) -> bool,
    ) -> Option<Intersection> {
        let mut best: Option<Intersection> = None;
        self.visit(ray, &mut |primitive, reach: &mut f64| {
            let intersection = primitive.intersection(ray, left == Some(primitive.index));
            if let Some(intersection) = intersection.filter(|c| c.t < *reach && counts(c)) {
                *reach = intersection.t;
                best = Some(intersection);
            }
        });
        best
    }

    /// The nearest accepted intersection of a ray that starts on the primitive `left`, if on any, beyond those at which
    /// it `crossed` primitives before.
    pub(super) fn next(
        &self,
        ray: &Ray,
        left: Option<usize>,
        crossed: &[Intersection],
        counts: impl Fn(&Intersection) -> bool,
    ) -> Option<Intersection> {
        let mut best: Option<Intersection> = None;
        self.visit(ray, &mut |primitive, reach: &mut f64| {
            let before = crossed.iter().rev().find(|c| c.primitive == primitive.index);
            let intersection = match before {
                None => primitive.intersection(ray, left == Some(primitive.index)),
                Some(before) => primitive.intersection(ray, true).filter(|c| c.t > before.t),
            };
            if let Some(intersection) = intersection.filter(|c| c.t < *reach && counts(c)) {
                *reach = intersection.t;
                best = Some(intersection);
            }
        });
        best
    }

    /// All intersections of a ray, nearest first, at most one per primitive, found without the tree.
    #[must_use]
    pub fn intersections(&self, ray: &Ray, left: Option<usize>) -> Vec<Intersection> {
        let all = self.primitives.iter().filter_map(|p| p.intersection(ray, left == Some(p.index)));
        let mut before: Vec<_> = all.filter(|c| c.t < ray.t_max).collect();
        before.sort_by(|a, b| a.t.total_cmp(&b.t));
        before
    }

    /// Visits all primitives whose box the ray hits before `reach`, which the visitor may shorten.
    pub(super) fn visit(&self, ray: &Ray, see: &mut dyn FnMut(&Primitive, &mut f64)) {
        if let Some(wide) = &self.wide {
            return wide.visit(ray, &self.primitives, see);
        }
        let inverse = ray.direction.recip();
        let mut reach = ray.t_max;
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            match self.nodes.get(index) {
                Some(Node::Inner { bounds, right }) if bounds.meets(ray, inverse, reach) => {
                    stack.extend([*right, index + 1]);
                }
                Some(Node::Leaf { bounds, items }) if bounds.meets(ray, inverse, reach) => {
                    self.primitives[items.clone()].iter().for_each(|p| see(p, &mut reach));
                }
                _ => {}
            }
        }
    }
}

/// Splits at the median centre along the longest side; children follow their parent.
fn build(nodes: &mut Vec<Node>, items: &mut [(Box3, Primitive)], range: Range<usize>) {
    let Some(bounds) = items[range.clone()].iter().map(|(b, _)| *b).reduce(Box3::union) else { return };
    // Enlarged for grazing rays and for f32 rays that miss by a rounding error.
    let bounds = bounds.inflated();
    if range.len() <= 4 {
        nodes.push(Node::Leaf { bounds, items: range });
        return;
    }
    let size = bounds.high - bounds.low;
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let middle = range.len() / 2;
    let center = |item: &(Box3, Primitive)| item.0.low[axis] + item.0.high[axis];
    items[range.clone()].select_nth_unstable_by(middle, |a, b| center(a).total_cmp(&center(b)));
    let parent = nodes.len();
    nodes.push(Node::Inner { bounds, right: 0 });
    build(nodes, items, range.start..range.start + middle);
    let second = nodes.len();
    build(nodes, items, range.start + middle..range.end);
    if let Node::Inner { right, .. } = &mut nodes[parent] {
        *right = second;
    }
}

impl Box3 {
    fn of(primitive: &Primitive) -> Self {
        let (low, high) = primitive.bounds();
        Self { low, high }
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn inflated(self) -> Self {
        let by =
            ROUNDING * (self.low.abs().max(self.high.abs()).max_element() + (self.high - self.low).length());
        Self { low: self.low - by, high: self.high + by }
    }

    fn meets(&self, ray: &Ray, inverse: DVec3, reach: f64) -> bool {
        let (mut near, mut far) = (0.0_f64, reach);
        for axis in 0..3 {
            let (low, high) = (self.low[axis] - ray.origin[axis], self.high[axis] - ray.origin[axis]);
            if ray.direction[axis] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return false;
                }
                continue;
            }
            let (a, b) = (low * inverse[axis], high * inverse[axis]);
            // An f32 hit may be nearer or farther by a rounding error.
            near = near.max(a.min(b) * (1.0 - ROUNDING));
            far = far.min(a.max(b) * (1.0 + ROUNDING));
        }
        near <= far
    }
}

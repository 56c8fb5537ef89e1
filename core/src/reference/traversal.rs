//! What a ray hits, in f64 on the CPU: a median-split tree of boxes and Moeller-Trumbore. And the judgement of an f32
//! answer, with tolerances from the rounding of f32 instead of guesses:
//!
//! ```text
//! e        = 16 x 2^-24                     a handful of roundings
//! S        = largest distance from the ray's origin to a corner
//! D        = |e1 . (d x e2)|                twice the triangle's area as the ray sees it (d of unit length)
//! slack    = e S (longest edge) / D         how far off barycentric coordinates may be
//! dt       = slack (longest edge) + e S      how far off the distance may be: it is interpolated from the corners'
//! ```

use std::ops::Range;

use crate::Scene;
use glam::DVec3;

const ROUNDING: f64 = 16.0 / 16_777_216.0;

/// A ray with a direction of unit length.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes.
    pub direction: DVec3,
    /// Where it ends.
    pub t_max: f64,
}

/// The first thing on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// OID.
    pub object: u32,
    /// Distance.
    pub t: f64,
}

/// How an f32 answer compares.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The same object at the same distance.
    Same,
    /// Another object at the same distance: two surfaces lie in one place.
    Tie,
    /// Another answer that rounding explains: it exists, and nothing lies clearly in front of it.
    Explained,
    /// A wrong answer, in words.
    Wrong(String),
}

enum Primitive {
    Triangle { corner: DVec3, e1: DVec3, e2: DVec3, object: u32 },
    Sphere { center: DVec3, radius: f64, object: u32 },
}

/// A possible hit: how far off its distance may be, and whether f32 must see it.
struct Candidate {
    hit: Hit,
    tolerance: f64,
    certain: bool,
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

/// A scene to shoot rays at.
pub struct Tracer {
    primitives: Vec<Primitive>,
    nodes: Vec<Node>,
}

impl Tracer {
    /// Everything in the scene but materials: holes cut by alpha are not seen.
    #[must_use]
    pub fn new(scene: &Scene) -> Self {
        let triangles = scene.positions.iter().zip(&scene.triangle_objects).map(|(corners, &object)| {
            let [a, b, c] = corners.map(|p| p.as_dvec3());
            Primitive::Triangle { corner: a, e1: b - a, e2: c - a, object }
        });
        let spheres = scene.spheres.iter().map(|s| Primitive::Sphere {
            center: s.center.as_dvec3(),
            radius: f64::from(s.radius),
            object: s.object,
        });
        let mut boxed: Vec<(Box3, Primitive)> = triangles.chain(spheres).map(|p| (p.bounds(), p)).collect();
        let mut nodes = Vec::new();
        let count = boxed.len();
        build(&mut nodes, &mut boxed, 0..count);
        Self { primitives: boxed.into_iter().map(|(_, p)| p).collect(), nodes }
    }

    /// The nearest hit.
    #[must_use]
    pub fn nearest(&self, ray: &Ray) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        self.visit(ray, &mut |primitive, reach: &mut f64| {
            if let Some(hit) = primitive.hit(ray).filter(|hit| hit.t < *reach) {
                *reach = hit.t;
                best = Some(hit);
            }
        });
        best
    }

    /// The nearest hit, without the tree.
    #[must_use]
    pub fn nearest_of_all(&self, ray: &Ray) -> Option<Hit> {
        let hits = self.primitives.iter().filter_map(|p| p.hit(ray)).filter(|hit| hit.t < ray.t_max);
        hits.min_by(|a, b| a.t.total_cmp(&b.t))
    }

    /// Judges the answer of an f32 tracer.
    #[must_use]
    pub fn judge(&self, ray: &Ray, answer: Option<Hit>) -> Verdict {
        let exact = self.nearest(ray);
        let mut candidates = Vec::new();
        self.visit(ray, &mut |primitive, _| candidates.extend(primitive.candidates(ray)));
        let claimed = answer.map(|answer| {
            candidates
                .iter()
                .filter(|c| c.hit.object == answer.object)
                .find(|c| (c.hit.t - answer.t).abs() <= c.tolerance)
                .map(|c| (answer.t, c.tolerance))
        });
        let reach = match claimed {
            Some(None) => {
                return Verdict::Wrong(format!("{answer:?} is not there; the first hit is {exact:?}"));
            }
            Some(Some((t, tolerance))) => t - tolerance,
            None => ray.t_max - ROUNDING * ray.t_max.min(1e30),
        };
        let missed = candidates.iter().filter(|c| c.certain).find(|c| c.hit.t + c.tolerance < reach);
        if let Some(missed) = missed {
            return Verdict::Wrong(format!("{answer:?} lies behind {:?}", missed.hit));
        }
        match (exact, answer) {
            (None, None) => Verdict::Same,
            (Some(a), Some(b)) if claimed_near(a, b, &candidates) => {
                if a.object == b.object {
                    Verdict::Same
                } else {
                    Verdict::Tie
                }
            }
            _ => Verdict::Explained,
        }
    }

    fn visit(&self, ray: &Ray, see: &mut dyn FnMut(&Primitive, &mut f64)) {
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

fn claimed_near(exact: Hit, answer: Hit, candidates: &[Candidate]) -> bool {
    candidates.iter().filter(|c| c.hit == exact).any(|c| (exact.t - answer.t).abs() <= c.tolerance)
}

/// Splits at the median centre along the longest side; children follow their parent.
fn build(nodes: &mut Vec<Node>, items: &mut [(Box3, Primitive)], range: Range<usize>) {
    let Some(bounds) = items[range.clone()].iter().map(|(b, _)| *b).reduce(Box3::union) else { return };
    // Rays that graze a box, and f32 rays that miss by a rounding, still look inside.
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
            // The box of an f32 hit may be a rounding nearer or farther.
            near = near.max(a.min(b) * (1.0 - ROUNDING));
            far = far.min(a.max(b) * (1.0 + ROUNDING));
        }
        near <= far
    }
}

impl Primitive {
    fn bounds(&self) -> Box3 {
        match *self {
            Self::Triangle { corner, e1, e2, .. } => {
                let (b, c) = (corner + e1, corner + e2);
                Box3 { low: corner.min(b).min(c), high: corner.max(b).max(c) }
            }
            Self::Sphere { center, radius, .. } => Box3 { low: center - radius, high: center + radius },
        }
    }

    fn hit(&self, ray: &Ray) -> Option<Hit> {
        match *self {
            Self::Triangle { corner, e1, e2, object } => {
                let (u, v, t, _) = moeller_trumbore(ray, corner, e1, e2)?;
                (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(Hit { object, t })
            }
            Self::Sphere { center, radius, object } => {
                let (b, u) = sphere_terms(ray, center, radius);
                if u < 0.0 {
                    return None;
                }
                let t = if b - u.sqrt() > 0.0 { b - u.sqrt() } else { b + u.sqrt() };
                (t > 0.0).then_some(Hit { object, t })
            }
        }
    }

    /// Every hit that f32 may see.
    fn candidates(&self, ray: &Ray) -> Vec<Candidate> {
        match *self {
            Self::Triangle { corner, e1, e2, object } => {
                let Some((u, v, t, seen_area)) = moeller_trumbore(ray, corner, e1, e2) else {
                    return Vec::new();
                };
                let to = corner - ray.origin;
                let span = to.length().max((to + e1).length()).max((to + e2).length());
                let longest = e1.length().max(e2.length()).max((e2 - e1).length());
                let slack = ROUNDING * span * longest / seen_area;
                let tolerance = slack * longest + ROUNDING * span;
                let margin = u.min(v).min(1.0 - u - v);
                let inside = margin >= -slack && t >= -tolerance && t <= ray.t_max + tolerance;
                let certain = margin > slack && t > tolerance;
                if inside {
                    vec![Candidate { hit: Hit { object, t }, tolerance, certain }]
                } else {
                    Vec::new()
                }
            }
            Self::Sphere { center, radius, object } => {
                let (b, u) = sphere_terms(ray, center, radius);
                let span = (center - ray.origin).length() + radius;
                let doubt = ROUNDING * span * span;
                if u < -doubt {
                    return Vec::new();
                }
                let root = u.max(0.0).sqrt();
                let tolerance = (u + doubt).max(0.0).sqrt() - (u - doubt).max(0.0).sqrt() + ROUNDING * span;
                [b - root, b + root]
                    .into_iter()
                    .filter(|t| *t >= -tolerance && *t <= ray.t_max + tolerance)
                    .map(|t| Candidate {
                        hit: Hit { object, t },
                        tolerance,
                        certain: u > doubt && t > tolerance,
                    })
                    .collect()
            }
        }
    }
}

/// Barycentric coordinates, distance, and twice the area as the ray sees it; `None` for a triangle seen edge-on.
fn moeller_trumbore(ray: &Ray, corner: DVec3, e1: DVec3, e2: DVec3) -> Option<(f64, f64, f64, f64)> {
    let p = ray.direction.cross(e2);
    let determinant = e1.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = ray.origin - corner;
    let q = s.cross(e1);
    let scale = determinant.recip();
    Some((s.dot(p) * scale, ray.direction.dot(q) * scale, e2.dot(q) * scale, determinant.abs()))
}

/// `b` and `u` of `t = b +- sqrt(u)`.
fn sphere_terms(ray: &Ray, center: DVec3, radius: f64) -> (f64, f64) {
    let to_center = center - ray.origin;
    let b = ray.direction.dot(to_center);
    let beside = to_center - b * ray.direction;
    (b, radius * radius - beside.length_squared())
}

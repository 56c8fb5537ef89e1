//! Judges f32 hits, with tolerances derived from the rounding of f32:
//!
//! ```text
//! e        = ulps x 2^-23                    the roundings that are allowed for
//! S        = largest distance from the ray's origin to a corner
//! D        = |e1 . (d x e2)|                twice the triangle's area as the ray sees it (d of unit length)
//! slack    = e S (longest edge) / D         how far off barycentric coordinates may be
//! dt       = slack (longest edge) + e S      how far off the distance may be: it is interpolated from the corners'
//! ```

use super::{
    intersection::{Primitive, Ray, Shape, moeller_trumbore, sphere_terms},
    traversal::{Hit, TRAVERSAL_ULPS, Tracer},
};

/// How a hit computed in f32 compares with the f64 reference.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The same object at the same distance within rounding.
    Same,
    /// Another object at the same distance: coincident surfaces.
    Tie,
    /// Another hit that rounding explains: it exists, and nothing lies clearly in front of it.
    Explained,
    /// The hit is wrong; the text says how.
    Wrong(String),
}

/// A possible hit, with the error of its distance and whether f32 must find it.
struct Candidate {
    hit: Hit,
    tolerance: f64,
    certain: bool,
}

impl Tracer {
    /// Judges the hit of an f32 tracer, allowing for a few roundings.
    #[must_use]
    pub fn judge(&self, ray: &Ray, answer: Option<Hit>) -> Verdict {
        self.judge_within(ray, answer, TRAVERSAL_ULPS)
    }

    /// Judges the hit of an f32 tracer whose corners may be displaced by `ulps` units in the last place of their
    /// distance, at most 8.
    #[must_use]
    pub fn judge_within(&self, ray: &Ray, answer: Option<Hit>, ulps: f64) -> Verdict {
        let rounding = ulps * f64::from(f32::EPSILON);
        let exact = self.nearest(ray);
        let mut candidates = Vec::new();
        self.visit(ray, &mut |primitive, _| candidates.extend(primitive.candidates(ray, rounding)));
        let claimed = answer.map(|answer| {
            let told =
                |c: &&Candidate| c.hit.object == answer.object && (c.hit.t - answer.t).abs() <= c.tolerance;
            let near = candidates.iter().find(told).map(|c| (answer.t, c.tolerance));
            // Rounding may place a hit on a sliver outside its bounding box, so all primitives of the object are
            // tested.
            let own = || self.primitives.iter().filter(|p| p.object == answer.object);
            let far = || own().flat_map(|p| p.candidates(ray, rounding)).find(|c| told(&c));
            near.or_else(|| far().map(|c| (answer.t, c.tolerance)))
        });
        let reach = match claimed {
            Some(None) => {
                return Verdict::Wrong(format!("{answer:?} is not there; the first hit is {exact:?}"));
            }
            Some(Some((t, tolerance))) => t - tolerance,
            None => ray.t_max - rounding * ray.t_max.min(1e30),
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
}

fn claimed_near(exact: Hit, answer: Hit, candidates: &[Candidate]) -> bool {
    candidates.iter().filter(|c| c.hit == exact).any(|c| (exact.t - answer.t).abs() <= c.tolerance)
}

impl Primitive {
    /// All hits that an f32 traversal may report as the closest, given its rounding errors.
    fn candidates(&self, ray: &Ray, rounding: f64) -> Vec<Candidate> {
        match self.shape {
            Shape::Triangle { corner, e1, e2 } => {
                let Some((u, v, t, seen_area)) = moeller_trumbore(ray, corner, e1, e2) else {
                    return Vec::new();
                };
                let to = corner - ray.origin;
                let span = to.length().max((to + e1).length()).max((to + e2).length());
                let longest = e1.length().max(e2.length()).max((e2 - e1).length());
                let slack = rounding * span * longest / seen_area;
                let tolerance = slack * longest + rounding * span;
                let margin = u.min(v).min(1.0 - u - v);
                let inside = margin >= -slack && t >= -tolerance && t <= ray.t_max + tolerance;
                let certain = margin > slack && t > tolerance;
                if inside {
                    vec![Candidate { hit: Hit { object: self.object, t }, tolerance, certain }]
                } else {
                    Vec::new()
                }
            }
            Shape::Sphere { center, radius } => {
                let (b, u) = sphere_terms(ray, center, radius);
                let span = (center - ray.origin).length() + radius;
                let doubt = rounding * span * span;
                if u < -doubt {
                    return Vec::new();
                }
                let root = u.max(0.0).sqrt();
                let tolerance = (u + doubt).max(0.0).sqrt() - (u - doubt).max(0.0).sqrt() + rounding * span;
                [b - root, b + root]
                    .into_iter()
                    .filter(|t| *t >= -tolerance && *t <= ray.t_max + tolerance)
                    .map(|t| Candidate {
                        hit: Hit { object: self.object, t },
                        tolerance,
                        certain: u > doubt && t > tolerance,
                    })
                    .collect()
            }
        }
    }
}

//! Intersection of rays with triangles (Moeller & Trumbore 1997) and spheres.

use glam::DVec3;

/// A ray with its cone.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Origin in world space.
    pub origin: DVec3,
    /// Direction in world space, of unit length.
    pub direction: DVec3,
    /// Largest ray parameter (distance) that counts as a hit.
    pub t_max: f64,
    /// Width of the ray's cone at the origin; negative after a focus.
    pub width: f64,
    /// Growth of the cone's width per unit of length.
    pub growth: f64,
}

/// The intersection of a ray with one primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// Ray parameter of the intersection.
    pub t: f64,
    /// Index of the primitive: triangles first, then spheres.
    pub primitive: usize,
    /// OID of the primitive's object.
    pub object: u32,
    /// Barycentric weight of the triangle's second corner.
    pub u: f64,
    /// Barycentric weight of the triangle's third corner.
    pub v: f64,
}

pub(super) enum Shape {
    Triangle { corner: DVec3, e1: DVec3, e2: DVec3 },
    Sphere { center: DVec3, radius: f64 },
}

pub(super) struct Primitive {
    pub shape: Shape,
    pub object: u32,
    pub index: usize,
}

impl Primitive {
    /// The primitive's axis-aligned bounding box.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        match self.shape {
            Shape::Triangle { corner, e1, e2 } => {
                let (b, c) = (corner + e1, corner + e2);
                (corner.min(b).min(c), corner.max(b).max(c))
            }
            Shape::Sphere { center, radius } => (center - radius, center + radius),
        }
    }

    /// The first intersection in front of the ray. A ray that starts on the primitive (`left`) does not hit it
    /// again, except that it may cross a sphere to the far side.
    pub fn intersection(&self, ray: &Ray, left: bool) -> Option<Intersection> {
        let (t, u, v) = match self.shape {
            Shape::Triangle { corner, e1, e2 } => {
                let (u, v, t, _) = moeller_trumbore(ray, corner, e1, e2)?;
                let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
                (!left && inside).then_some((t, u, v))?
            }
            Shape::Sphere { center, radius } => {
                let (b, u) = sphere_terms(ray, center, radius);
                let root = (u >= 0.0 || left).then(|| u.max(0.0).sqrt())?;
                let t = match left {
                    // A ray leaving outwards hits nothing more; one going inwards hits the far side.
                    true if b <= 0.0 => return None,
                    true => b + root,
                    false if b - root > 0.0 => b - root,
                    false => b + root,
                };
                (t, 0.0, 0.0)
            }
        };
        (t > 0.0).then_some(Intersection { t, primitive: self.index, object: self.object, u, v })
    }
}

/// Barycentric coordinates, distance, and twice the projected area; `None` for a triangle seen edge-on.
pub(super) fn moeller_trumbore(
    ray: &Ray,
    corner: DVec3,
    e1: DVec3,
    e2: DVec3,
) -> Option<(f64, f64, f64, f64)> {
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

/// The terms `b` and `u` of a sphere's ray parameters `t = b +- sqrt(u)`.
pub(super) fn sphere_terms(ray: &Ray, center: DVec3, radius: f64) -> (f64, f64) {
    let to_center = center - ray.origin;
    let b = ray.direction.dot(to_center);
    let beside = to_center - b * ray.direction;
    (b, radius * radius - beside.length_squared())
}

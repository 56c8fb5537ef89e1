//! Ray cones: the width of a sample's region along its rays, and its footprint in textures.

use glam::{DVec2, DVec3};

use super::{Intersection, Ray, Reference, Surface};
use crate::scene::octahedral_decode_exact;

/// Least cosine at a surface, and greatest growth of a cone.
const LEAST_COSINE: f64 = 1.0e-4;
const MOST_GROWTH: f64 = 8.0;
/// Squares below this are zero in f32.
const LEAST_SQUARE: f64 = 1.0e-30;

/// Second moments (ss, tt, st) of the axes of the ellipse in which a cone of this width intersects a triangle.
pub(super) fn footprint(
    width: f64,
    direction: DVec3,
    [a, b, c]: [DVec3; 3],
    [ta, tb, tc]: [DVec2; 3],
) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let cross = ab.cross(ac);
    let Some(normal) = cross.try_normalize() else { return DVec3::ZERO };
    let cosine = normal.dot(direction);
    let cosine = cosine.abs().max(LEAST_COSINE) * cosine.signum();
    // Intersections of two parallel rays next to this one with the triangle's plane.
    let (x, y) = direction.any_orthonormal_pair();
    let moved = [x, y].map(|side| {
        let on_plane = width * (side - side.dot(normal) / cosine * direction);
        let second = on_plane.cross(ac).dot(cross) / cross.length_squared();
        let third = ab.cross(on_plane).dot(cross) / cross.length_squared();
        second * (tb - ta) + third * (tc - ta)
    });
    moved.iter().map(|t| DVec3::new(t.x * t.x, t.y * t.y, t.x * t.y)).sum()
}

impl Reference {
    /// Mean curvature: turn of the normal per unit of length, positive where the surface is convex towards the
    /// viewer; for a triangle the mean over its three sides.
    pub(super) fn curvature(&self, s: &Surface) -> f64 {
        let outside = match self.scene.spheres.get(s.primitive.wrapping_sub(self.scene.positions.len())) {
            Some(sphere) => f64::from(sphere.radius).recip(),
            None => {
                let corners = self.scene.positions[s.primitive].map(|p| p.as_dvec3());
                let normals = self.scene.normals[s.primitive].map(octahedral_decode_exact);
                let along = |i: usize, j: usize| {
                    let side = corners[j] - corners[i];
                    (normals[j] - normals[i]).dot(side) / side.length_squared().max(LEAST_SQUARE)
                };
                (along(0, 1) + along(1, 2) + along(2, 0)) / 3.0
            }
        };
        if s.inside { -outside } else { outside }
    }

    /// Width and growth of the cone of a ray that leaves the surface. If the normal turns by an angle, a
    /// reflected ray turns by twice that and a refracted one by its direction's component along the normal
    /// (`turned`); `kept` is the component along the incident direction.
    pub(super) fn bent(&self, s: &Surface, kept: f64, turned: f64) -> (f64, f64) {
        let growth = kept * s.growth + turned * self.curvature(s) * s.width;
        (s.width, growth.clamp(-MOST_GROWTH, MOST_GROWTH))
    }

    /// The cone's footprint in the object's textures at an intersection.
    pub(super) fn covered(&self, ray: &Ray, intersection: &Intersection) -> DVec3 {
        let corners = self.scene.positions.get(intersection.primitive);
        match (
            corners,
            self.scene.texcoords.get(intersection.primitive),
            self.first_texture(intersection.object),
        ) {
            (Some(corners), Some(texcoords), Some(_)) => footprint(
                ray.width + intersection.t * ray.growth,
                ray.direction,
                corners.map(|p| p.as_dvec3()),
                texcoords.map(|t| t.as_dvec2()),
            ),
            _ => DVec3::ZERO,
        }
    }
}

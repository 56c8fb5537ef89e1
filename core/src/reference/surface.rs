//! The surface at a hit, and the rays that leave it. Spawned rays start exactly at the hit point and ignore the
//! primitive that they leave, instead of starting at an offset.

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles};

use super::{Cause, Intersection, Maps, Ray, Reference, Rounding};
use crate::scene::octahedral_decode_exact;

/// A surface point with everything that shading needs.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Position in world space.
    pub position: DVec3,
    /// Barycentric weights of a triangle's second and third corner.
    pub barycentric: DVec2,
    /// OID of the object.
    pub object: u32,
    /// Index of the primitive.
    pub primitive: usize,
    /// Unit shading normal on the viewer's side of the face.
    pub normal: DVec3,
    /// Unit normal of the face on the viewer's side.
    pub face: DVec3,
    /// Whether the ray arrives from behind the surface.
    pub inside: bool,
    /// Interpolated texture coordinates, neither wrapped nor clamped.
    pub texcoord: DVec2,
    /// Interpolated vertex colour, linear RGB.
    pub color: DVec3,
    /// Interpolated alpha of the vertices.
    pub alpha: f64,
    /// Width of the ray's cone at the hit.
    pub width: f64,
    /// Growth of the cone's width per unit of distance.
    pub growth: f64,
    /// Footprint: second moments (ss, tt, st) in texture coordinates.
    pub footprint: DVec3,
    /// What extended materials need.
    pub maps: Maps,
    /// Scale of the position's rounding errors: coordinates along the normal and the primitive's size.
    pub extent: f64,
    /// Distance within which other surfaces touch this one where solids touch.
    pub offset: f64,
    /// Distance from the face at which spawned rays start: beyond all surfaces that touch.
    pub contact: f64,
}

/// If the corners of a triangle have one normal within 1 - cos of this of the face's, the face's is used: the
/// difference is due to the encoding.
const FLAT_ERROR: f64 = 2.0e-7;

/// Surfaces touch within the offset of the shaders' rays from a face: these shares of its coordinates along the normal
/// and of its size.
const TOUCHING_COORDINATES: f64 = 4.0 / 16_777_216.0;
const TOUCHING_SIZE: f64 = 40.0 / 16_777_216.0;

impl Reference {
    /// The surface where `ray` crosses a primitive.
    #[must_use]
    pub fn surface(&self, ray: &Ray, intersection: &Intersection, rounding: &mut Rounding) -> Surface {
        let spheres = &self.scene.spheres;
        let triangles = self.scene.positions.len();
        let at = ray.origin + intersection.t * ray.direction;
        let (position, mut normal, mut face, low, high) = match spheres
            .get(intersection.primitive.wrapping_sub(triangles))
        {
            Some(sphere) => {
                let (center, radius) = (sphere.center.as_dvec3(), f64::from(sphere.radius));
                let normal = (at - center).normalize_or_zero();
                (center + radius * normal, normal, normal, center - radius, center + radius)
            }
            None => {
                let [a, b, c] = self.scene.positions[intersection.primitive].map(|p| p.as_dvec3());
                let [na, nb, nc] = self.scene.normals[intersection.primitive].map(octahedral_decode_exact);
                let w = 1.0 - intersection.u - intersection.v;
                let normal = (w * na + intersection.u * nb + intersection.v * nc).normalize_or_zero();
                let face = (b - a).cross(c - a).normalize_or_zero();
                // The shading normals define the outside; the winding may contradict them.
                let face = if face.dot(normal) < 0.0 { -face } else { face };
                let [first, others @ ..] = self.scene.normals[intersection.primitive];
                let flat = others == [first; 2] && normal.dot(face) > 1.0 - FLAT_ERROR;
                let normal = if flat { face } else { normal };
                let position = w * a + intersection.u * b + intersection.v * c;
                (position, normal, face, a.min(b).min(c), a.max(b).max(c))
            }
        };
        normal = rounding.direction(Cause::Silhouette, normal);
        let inside = face.dot(ray.direction) > 0.0;
        if inside {
            (normal, face) = (-normal, -face);
        }
        let color = self.vertex_color(intersection);
        let coordinates = face.abs().dot(low.abs().max(high.abs()));
        let size = (high - low).max_element();
        Surface {
            position,
            barycentric: DVec2::new(intersection.u, intersection.v),
            object: intersection.object,
            primitive: intersection.primitive,
            normal,
            face,
            inside,
            texcoord: self.texcoord(intersection, rounding),
            color: color.xyz(),
            alpha: color.w,
            width: ray.width + intersection.t * ray.growth,
            growth: ray.growth,
            footprint: self.covered(ray, intersection),
            maps: self.maps(ray, intersection, inside, rounding),
            extent: coordinates + size,
            offset: TOUCHING_COORDINATES * coordinates + TOUCHING_SIZE * size,
            contact: 0.0,
        }
    }

    /// Texture coordinates at an intersection; (0, 0) if the scene has none.
    pub(super) fn texcoord(&self, intersection: &Intersection, rounding: &mut Rounding) -> DVec2 {
        let Some(corners) = self.scene.texcoords.get(intersection.primitive) else { return DVec2::ZERO };
        let [a, b, c] = corners.map(|t| t.as_dvec2());
        let at = (1.0 - intersection.u - intersection.v) * a + intersection.u * b + intersection.v * c;
        let largest = a.abs().max(b.abs()).max(c.abs()).max_element().max(1.0);
        rounding.pair(Cause::TexelEdge, at, largest)
    }

    /// Interpolated vertex colour, linear RGBA; white if the scene has none.
    pub(super) fn vertex_color(&self, intersection: &Intersection) -> DVec4 {
        let Some(corners) = self.scene.colors.get(intersection.primitive) else { return DVec4::ONE };
        let [a, b, c] = corners.map(|rgba| DVec4::from_array(rgba.map(|x| f64::from(x) / 65535.0)));
        (1.0 - intersection.u - intersection.v) * a + intersection.u * b + intersection.v * c
    }
}

impl Surface {
    /// A ray that leaves the surface, with its cone's width and growth.
    #[must_use]
    pub fn spawn(&self, direction: DVec3, (width, growth): (f64, f64), rounding: &mut Rounding) -> Ray {
        let off = self.contact + rounding.spawn(Cause::Silhouette, self.extent);
        let side = if direction.dot(self.face) >= 0.0 { off } else { -off };
        let origin = self.position + side * self.face;
        Ray { origin, direction, t_max: f64::INFINITY, width, growth }
    }
}

//! Normal maps, and textures with coordinates of their own.

use glam::{DMat2, DVec2, DVec3, DVec4, Vec4Swizzles as _};

use super::{
    Cause, Intersection, Ray, Reference, Rounding, attributes, cone, surface::Surface, texture::Encoding,
};
use crate::{
    Features,
    scene::{TextureSlot, tangent_decode_exact, tangent_encode},
};

/// Least cosine between the face and a ray mirrored by a normal map's normal.
const LEAST_MIRRORED: f64 = 0.01;
/// Lengths of averaged normals from here on count as 1.
const NORMAL_LENGTH: f64 = 0.98;

/// What extended materials need of a surface, besides what all do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Maps {
    /// Unit tangent on the viewer's side.
    pub tangent: DVec3,
    /// Sign of the bitangent.
    pub sign: f64,
    /// The first set of texture coordinates, not wrapped.
    pub first: DVec2,
    /// Texture coordinates of the object's second set at the hit.
    pub second: DVec2,
    /// Second moments (ss, tt, st) of the footprint in the second set.
    pub second_footprint: DVec3,
}

/// Where a slot's texture is read: texture coordinates and second moments of the footprint.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub texcoord: DVec2,
    pub footprint: DVec3,
}

impl Maps {
    /// Perspective-correct interpolation; `weight` is that of `a`.
    pub(super) fn interpolated(a: &Self, b: &Self, weight: f64) -> Self {
        let footprint = |m: &Self| attributes::footprint(m.second_footprint);
        Self {
            tangent: (weight * a.tangent + (1.0 - weight) * b.tangent).normalize_or_zero(),
            sign: a.sign,
            first: a.first.lerp(b.first, 1.0 - weight),
            second: a.second.lerp(b.second, 1.0 - weight),
            second_footprint: attributes::moments(0.5 * (footprint(a) + footprint(b))),
        }
    }

    /// The values after quantisation for storage.
    pub(super) fn stored(&self, features: &Features, rounding: &mut Rounding) -> Self {
        let mut stored = Self::default();
        if features.tangents {
            let tangent = rounding.direction(Cause::Storage, self.tangent);
            (stored.tangent, stored.sign) =
                tangent_decode_exact(tangent_encode(tangent.as_vec3(), self.sign < 0.0));
        }
        if features.slot_coordinates {
            let footprint = attributes::footprint(self.second_footprint);
            let footprint = attributes::stored_footprint(attributes::displaced(footprint, rounding));
            stored.first = self.first.as_vec2().as_dvec2();
            stored.second = self.second.as_vec2().as_dvec2();
            stored.second_footprint = attributes::moments(footprint);
        }
        stored
    }
}

impl Reference {
    /// What extended materials need at an intersection; `inside` means that the ray arrives from behind.
    pub(super) fn maps(
        &self,
        ray: &Ray,
        intersection: &Intersection,
        inside: bool,
        rounding: &mut Rounding,
    ) -> Maps {
        let material = self.material_of(intersection.object);
        let primitive = intersection.primitive;
        let weights = DVec3::new(1.0 - intersection.u - intersection.v, intersection.u, intersection.v);
        let mut maps = Maps::default();
        if let Some(corners) = self.scene.tangents.get(primitive).filter(|_| material.reads_tangents()) {
            let [(a, sign), (b, _), (c, _)] = corners.map(tangent_decode_exact);
            let side = if inside { -1.0 } else { 1.0 };
            let tangent = weights.x * a + weights.y * b + weights.z * c;
            (maps.tangent, maps.sign) = (side * tangent.normalize_or_zero(), side * sign);
        }
        if !material.coordinates.is_empty() {
            maps.first = self.texcoord(intersection, rounding);
        }
        let twice = material.coordinates.values().any(|c| c.second);
        let corners = self.scene.second_texcoords.get(primitive).filter(|_| twice);
        if let (Some(corners), Some(positions)) = (corners, self.scene.positions.get(primitive)) {
            let [a, b, c] = corners.map(|t| t.as_dvec2());
            let second = weights.x * a + weights.y * b + weights.z * c;
            let largest = a.abs().max(b.abs()).max(c.abs()).max_element().max(1.0);
            maps.second = rounding.pair(Cause::TexelEdge, second, largest);
            maps.second_footprint = cone::footprint(
                ray.width + intersection.t * ray.growth,
                ray.direction,
                positions.map(|p| p.as_dvec3()),
                [a, b, c],
            );
        }
        maps
    }

    /// A slot's texture, averaged over the footprint; ones without a texture.
    pub(super) fn slot(&self, object: u32, slot: TextureSlot, first: Place, maps: &Maps) -> DVec4 {
        let material = self.material_of(object);
        let place = match material.coordinates.get(&slot) {
            None => first,
            Some(c) => {
                let linear = DMat2::from_cols(c.transform.x_axis.as_dvec2(), c.transform.y_axis.as_dvec2());
                let (from, m) = if c.second {
                    (maps.second, maps.second_footprint)
                } else {
                    (maps.first, first.footprint)
                };
                let moments = DMat2::from_cols(DVec2::new(m.x, m.z), DVec2::new(m.z, m.y));
                let moved = linear * moments * linear.transpose();
                Place {
                    texcoord: linear * from + c.transform.translation.as_dvec2(),
                    footprint: DVec3::new(moved.x_axis.x, moved.y_axis.y, moved.x_axis.y),
                }
            }
        };
        let encoding = if slot.is_color() { Encoding::Srgb } else { Encoding::Linear };
        self.texture(material.texture(slot), encoding, place.texcoord, place.footprint)
    }

    /// The averaged normal of an object's normal map in the tangent frame, not normalised.
    pub(super) fn bump(&self, object: u32, first: Place, maps: &Maps) -> Option<DVec3> {
        self.material_of(object)
            .has_normal_map()
            .then(|| 2.0 * self.slot(object, TextureSlot::Normal, first, maps).xyz() - 1.0)
    }

    /// Transmittance of what a ray has crossed when it arrives at a surface: an absorbing solid that it leaves.
    pub(super) fn absorbed(&self, s: &Surface, distance: f64) -> DVec3 {
        let m = self.material_of(s.object);
        if !s.inside || m.thin || m.transmission == 0.0 && !m.is_translucent() {
            return DVec3::ONE;
        }
        (-distance * m.absorption.as_dvec3()).exp()
    }

    /// The surface with the normal of its normal map, if it has one, and its material with that of its coat.
    #[must_use]
    pub fn bumped(&self, s: &Surface, m: super::Material, direction: DVec3) -> (Surface, super::Material) {
        let apart = self.features.coat_normals;
        let m = m.oriented(apart, s.normal, s.face, -direction, &s.maps);
        (Surface { normal: m.normal(s.normal, s.face, -direction, &s.maps), ..*s }, m)
    }
}

impl super::Material {
    /// The shading normal for a view direction: that of the normal map, where the surface mirrors bent so that the mirrored
    /// ray leaves on the viewer's side of the face.
    pub(super) fn normal(&self, normal: DVec3, face: DVec3, view: DVec3, maps: &Maps) -> DVec3 {
        self.bent(self.bump, self.gloss() > 0.0, normal, face, view, maps)
    }

    /// A normal bent by a normal of a normal map, if there is one; `mirrors` keeps mirrored rays above the face.
    pub(super) fn bent(
        &self,
        bump: Option<DVec3>,
        mirrors: bool,
        normal: DVec3,
        face: DVec3,
        view: DVec3,
        maps: &Maps,
    ) -> DVec3 {
        let along = maps.tangent - normal.dot(maps.tangent) * normal;
        let Some(bump) = bump.filter(|_| along.length_squared() >= 1.0e-8) else { return normal };
        let tangent = along.normalize();
        let bitangent = maps.sign * normal.cross(tangent);
        let bent = (bump.x * tangent + bump.y * bitangent + bump.z * normal).normalize_or_zero();
        if !mirrors {
            return bent;
        }
        let mirrored = 2.0 * bent.dot(view) * bent - view;
        let below = LEAST_MIRRORED.min(0.9 * face.dot(view).max(0.0)) - mirrored.dot(face);
        if below <= 0.0 {
            return bent;
        }
        (view + (mirrored + below * face).normalize_or_zero()).normalize_or_zero()
    }
}

/// Roughness of a surface whose averaged normal has this length (Toksvig 2004): the variance of the normals adds to
/// the reciprocal of the Blinn-Phong exponent 2 / roughness^4 - 2.
pub(super) fn toksvig(roughness: f64, length: f64) -> f64 {
    let length = (length / NORMAL_LENGTH).clamp(0.001, 1.0);
    if length == 1.0 || roughness >= 1.0 {
        return roughness;
    }
    let variance = (1.0 - length) / length;
    let exponent = (2.0 / roughness.powi(4) - 2.0).recip() + variance;
    (2.0 / (exponent.recip() + 2.0)).powf(0.25)
}

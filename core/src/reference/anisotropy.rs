//! Anisotropic microfacets (KHR_materials_anisotropy).

use glam::{DMat2, DMat3, DVec2, DVec3, DVec4, Vec4Swizzles as _};

use super::{Maps, Material};
use crate::scene;

/// The wider side of a lobe at a point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Anisotropy {
    /// Unit direction in the frame of tangent and bitangent.
    direction: DVec2,
    strength: f64,
    tangent: DVec3,
    /// Sign of the bitangent.
    sign: f64,
}

impl Anisotropy {
    /// The anisotropy of a material whose texture has this texel, if any; `None` for isotropic points.
    pub fn of(m: &scene::Material, texel: Option<DVec4>, maps: &Maps) -> Option<Self> {
        let drawn = texel.map_or(DVec2::X, |texel| 2.0 * texel.xy() - 1.0);
        let direction = if drawn.length_squared() > 1.0e-4 { drawn.normalize() } else { DVec2::X };
        let strength = f64::from(m.anisotropy) * texel.map_or(1.0, |texel| texel.z);
        let (tangent, sign) =
            if maps.tangent == DVec3::ZERO { (DVec3::Z, 1.0) } else { (maps.tangent, maps.sign) };
        let direction = DMat2::from_angle(f64::from(m.anisotropy_rotation)) * direction;
        (strength > 0.0).then_some(Self { direction, strength, tangent, sign })
    }

    /// Directions of the wider and the narrower side, and the normal.
    pub fn frame(&self, normal: DVec3) -> DMat3 {
        let beside = |v: DVec3| v - normal.dot(v) * normal;
        let mut along = beside(self.tangent);
        if along.length_squared() < 1.0e-8 {
            along = beside(DVec3::X);
        }
        let tangent = along.normalize();
        let bitangent = self.sign * normal.cross(tangent);
        let wide = self.direction.x * tangent + self.direction.y * bitangent;
        DMat3::from_cols(wide, normal.cross(wide), normal)
    }

    /// Widths of the lobe along both sides.
    pub fn alpha(&self, roughness: f64) -> DVec2 {
        let alpha = roughness * roughness;
        DVec2::new(alpha + (1.0 - alpha) * self.strength.powi(2), alpha)
    }
}

impl Material {
    /// Roughness along the wider side.
    pub(super) fn widest(&self) -> f64 {
        self.anisotropy.map_or(self.roughness, |a| a.alpha(self.roughness).x.sqrt())
    }

    /// Normal by which the filtered map is reflected: bent towards the plane of the view and the narrower side.
    pub(super) fn reflecting(&self, normal: DVec3, view: DVec3) -> DVec3 {
        let Some(a) = self.anisotropy else { return normal };
        let narrow = a.frame(normal).y_axis;
        let facing = view - view.dot(narrow) * narrow;
        if facing.length_squared() < 1.0e-8 {
            return normal;
        }
        let rest = (1.0 - a.strength * (1.0 - self.roughness)).powi(4);
        facing.normalize().lerp(normal, rest).normalize()
    }
}

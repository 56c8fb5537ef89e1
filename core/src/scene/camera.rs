//! Cameras, which define the primary rays.

use glam::{Mat4, Vec3};

/// A camera in world space. A point of the frame has coordinates x (right) and y (up), in units of half the
/// frame's height from the centre. The spread `x right + y up` is added to `forward` for the ray's direction
/// (perspective) or to `origin` for its origin (orthographic).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// World-space position of the eye (perspective) or of the frame's centre (orthographic).
    pub origin: Vec3,
    /// Vector to the right in the image plane, as long as half the frame's height.
    pub right: Vec3,
    /// Vector upwards in the image plane, as long as half the frame's height.
    pub up: Vec3,
    /// View direction: unit length unless the lens is shifted.
    pub forward: Vec3,
    /// Whether the projection is orthographic, with parallel rays.
    pub orthographic: bool,
}

/// Angle of a framing camera above the horizon in radians: 15 degrees.
const ELEVATION: f32 = std::f32::consts::PI / 12.0;

impl Camera {
    /// A perspective camera from a camera-to-world matrix (glTF: looks along -Z, Y up) and a vertical field of
    /// view in radians.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] where the matrix has no axes or the field of view is not inside (0, pi).
    pub fn perspective(world_from_camera: &Mat4, vertical_fov: f32) -> crate::Result<Self> {
        if !(vertical_fov > 0.0 && vertical_fov < std::f32::consts::PI) {
            return Err(crate::Error::scene(
                "camera",
                format!("expected a vertical field of view inside (0, pi) radians, found {vertical_fov}"),
            ));
        }
        let tan = (0.5 * f64::from(vertical_fov)).tan() as f32;
        Self::from_axes(world_from_camera, tan, false)
    }

    /// An orthographic camera that shows `2 half_height` world units from bottom to top.
    ///
    /// # Errors
    /// [`crate::Error::Scene`] where the matrix has no axes or the height is not positive and finite.
    pub fn orthographic(world_from_camera: &Mat4, half_height: f32) -> crate::Result<Self> {
        if !(half_height > 0.0 && half_height.is_finite()) {
            return Err(crate::Error::scene(
                "camera",
                format!("expected a positive orthographic height, found {half_height}"),
            ));
        }
        Self::from_axes(world_from_camera, half_height, true)
    }

    fn from_axes(world_from_camera: &Mat4, half_height: f32, orthographic: bool) -> crate::Result<Self> {
        let axis = |i: usize| world_from_camera.col(i).truncate().try_normalize();
        let origin = world_from_camera.w_axis.truncate();
        match (axis(0), axis(1), axis(2)) {
            (Some(x), Some(y), Some(z)) if origin.is_finite() => {
                Ok(Self { origin, right: x * half_height, up: y * half_height, forward: -z, orthographic })
            }
            _ => Err(crate::Error::scene("camera", "its node's matrix is singular or not finite".to_owned())),
        }
    }

    /// Origin and direction (of any length) of the ray through a point of the frame: x right and y up, in units of half
    /// of the frame's height from its centre.
    #[must_use]
    pub fn through(&self, [x, y]: [f32; 2]) -> (Vec3, Vec3) {
        let spread = x * self.right + y * self.up;
        if self.orthographic {
            (self.origin + spread, self.forward)
        } else {
            (self.origin, self.forward + spread)
        }
    }

    /// The camera turned to the right around its own upward axis, in degrees.
    #[must_use]
    pub fn panned(&self, degrees: f64) -> Self {
        let axis = self.up.as_dvec3().normalize_or_zero();
        let (sine, cosine) = (-degrees).to_radians().sin_cos();
        let turned = |v: Vec3| {
            let v = v.as_dvec3();
            let along = axis * axis.dot(v);
            (along + cosine * (v - along) + sine * axis.cross(v)).as_vec3()
        };
        Self { right: turned(self.right), forward: turned(self.forward), ..*self }
    }

    /// A camera at `eye` that looks at `target`, world Y up, with a vertical field of view in radians.
    ///
    /// # Errors
    /// The errors of [`Camera::perspective`]; also if `eye` is `target` or the view is vertical.
    pub fn look_at(eye: Vec3, target: Vec3, vertical_fov: f32) -> crate::Result<Self> {
        let forward = (target - eye).normalize_or_zero();
        let right = forward.cross(Vec3::Y).normalize_or_zero();
        let up = right.cross(forward);
        let matrix =
            Mat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), eye.extend(1.0));
        Self::perspective(&matrix, vertical_fov)
    }

    /// A camera with a field of view of 45 degrees that sees the whole box from its front (glTF: +Z), slightly from
    /// above.
    #[must_use]
    pub fn framing(low: Vec3, high: Vec3) -> Self {
        let center = 0.5 * (low + high);
        let radius = (0.5 * (high - low).length()).max(f32::MIN_POSITIVE.sqrt());
        let half_fov = 22.5_f32.to_radians();
        let back = Vec3::new(0.0, ELEVATION.sin(), ELEVATION.cos());
        let eye = center + back * (radius / half_fov.sin());
        Self::look_at(eye, center, 2.0 * half_fov).unwrap_or(Self {
            origin: center + Vec3::Z,
            right: Vec3::X * half_fov.tan(),
            up: Vec3::Y * half_fov.tan(),
            forward: -Vec3::Z,
            orthographic: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_pans_to_the_right() {
        let camera = Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, 1.0).expect("a camera");
        let turned = camera.panned(90.0);
        assert!((turned.forward - Vec3::X).length() < 1e-6, "{turned:?}");
        assert!((turned.right.normalize() - Vec3::Z).length() < 1e-6, "{turned:?}");
        assert_eq!((turned.up, turned.origin), (camera.up, camera.origin));
        assert!((camera.panned(30.0).panned(-30.0).forward - camera.forward).length() < 1e-6);
        assert_eq!(camera.panned(0.0), camera);
    }
}

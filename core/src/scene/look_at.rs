//! A camera by eye, target, up vector and projection.

use glam::{DVec3, Vec3};

use crate::{Camera, Error, Result};

/// The camera's projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// A pinhole camera: all rays start at the eye.
    Perspective {
        /// Angle between the lower and the upper edge of the image in degrees, inside (0, 180).
        vertical_fov_degrees: f32,
    },
    /// An orthographic camera: all rays are parallel.
    Orthographic {
        /// Distance between the lower and the upper edge of the image in world units.
        height: f32,
    },
}

/// A camera pose by eye, target, up vector and projection, as the command line states it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LookAt {
    /// Position of the eye in world space.
    pub eye: Vec3,
    /// World-space point in the centre of the image. Only its direction from the eye matters.
    pub target: Vec3,
    /// The up vector: any length, not parallel to the view direction.
    pub up: Vec3,
    /// The camera's projection.
    pub lens: Lens,
}

impl LookAt {
    /// Converts the pose to a camera, bitwise reproducibly.
    ///
    /// # Errors
    /// [`Error::Setting`] names `eye`, `target`, `up`, `fov` or `ortho` if a number is not finite, the target is
    /// the eye, the view is parallel to `up` (no other axis is guessed, as the image would turn with it), or the
    /// projection is out of range.
    pub fn camera(&self) -> Result<Camera> {
        for (option, point) in [("eye", self.eye), ("target", self.target), ("up", self.up)] {
            if !point.is_finite() {
                return Err(refused(option, "finite numbers", point));
            }
        }
        let eye = self.eye.as_dvec3();
        let Some(forward) = (self.target.as_dvec3() - eye).try_normalize() else {
            return Err(refused("target", "a point other than the eye", self.target));
        };
        let aside = self.up.as_dvec3().try_normalize().map_or(DVec3::ZERO, |up| forward.cross(up));
        if aside.length() < LEAST_SINE {
            return Err(refused("up", "a direction that is not along the view", self.up));
        }
        let right = aside.normalize();
        let (half_height, orthographic) = self.lens.half_height()?;
        Ok(Camera {
            origin: self.eye,
            right: (right * half_height).as_vec3(),
            up: (right.cross(forward) * half_height).as_vec3(),
            forward: forward.as_vec3(),
            orthographic,
        })
    }

    /// The pose of a camera with the target at `distance` from the eye. A lens shift and mirroring are lost, as a
    /// pose cannot express them.
    #[must_use]
    pub fn of(camera: &Camera, distance: f32) -> Self {
        let (right, up) = (camera.right.as_dvec3(), camera.up.as_dvec3());
        let given = camera.forward.as_dvec3();
        let ahead = up.cross(right).try_normalize().unwrap_or(given);
        let ahead = if ahead.dot(given) < 0.0 { -ahead } else { ahead };
        let lens = if camera.orthographic {
            Lens::Orthographic { height: (2.0 * up.length()) as f32 }
        } else {
            let half = up.length().atan2(ahead.dot(given));
            Lens::Perspective { vertical_fov_degrees: (2.0 * half).to_degrees() as f32 }
        };
        Self {
            eye: camera.origin,
            target: (camera.origin.as_dvec3() + ahead * f64::from(distance)).as_vec3(),
            up: up.normalize_or_zero().as_vec3(),
            lens,
        }
    }
}

/// Least sine of the angle between the view direction and `up`; below it, f32 rounding would decide the
/// orientation.
const LEAST_SINE: f64 = 1e-6;

impl Lens {
    /// Half the height of the image (at distance 1 if perspective), and whether rays are parallel.
    fn half_height(self) -> Result<(f64, bool)> {
        let (option, expected, found, half) = match self {
            Self::Perspective { vertical_fov_degrees: fov } => {
                let inside = fov > 0.0 && fov < 180.0;
                let half = if inside { (0.5 * f64::from(fov)).to_radians().tan() } else { 0.0 };
                ("fov", "degrees between 0 and 180", fov, half)
            }
            Self::Orthographic { height } => {
                ("ortho", "a positive finite height", height, 0.5 * f64::from(height))
            }
        };
        let half_as_held = half as f32;
        if !(half_as_held.is_normal() && half_as_held > 0.0) {
            return Err(Error::setting(option, expected, found.to_string()));
        }
        Ok((half, matches!(self, Self::Orthographic { .. })))
    }
}

fn refused(option: &str, expected: &str, found: Vec3) -> Error {
    Error::setting(option, expected, format!("{},{},{}", found.x, found.y, found.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOV: Lens = Lens::Perspective { vertical_fov_degrees: 50.0 };

    fn look_at(eye: [f32; 3], target: [f32; 3], up: [f32; 3]) -> LookAt {
        LookAt { eye: eye.into(), target: target.into(), up: up.into(), lens: FOV }
    }

    #[test]
    fn a_pose_with_y_up_is_look_at() {
        let posed = look_at([1.0, 2.0, 3.0], [-4.0, 0.5, 0.25], [0.0, 1.0, 0.0]).camera().expect("a camera");
        let looked =
            Camera::look_at(Vec3::new(1.0, 2.0, 3.0), Vec3::new(-4.0, 0.5, 0.25), 50_f32.to_radians())
                .expect("a camera");
        for (posed, looked) in
            [(posed.right, looked.right), (posed.up, looked.up), (posed.forward, looked.forward)]
        {
            assert!((posed - looked).length() < 1e-6, "{posed} {looked}");
        }
    }

    #[test]
    fn any_axis_may_be_up() {
        let camera = look_at([0.0; 3], [0.0, -3.0, 0.0], [1.0, 5.0, 0.0]).camera().expect("a camera");
        assert!((camera.forward - Vec3::NEG_Y).length() < 1e-6);
        assert!((camera.up.normalize() - Vec3::X).length() < 1e-6, "{}", camera.up);
        assert!((camera.right.normalize() - Vec3::NEG_Y.cross(Vec3::X)).length() < 1e-6);
    }

    #[test]
    fn poses_of_cameras_make_them_again() {
        for lens in [FOV, Lens::Orthographic { height: 3.5 }] {
            let camera = LookAt { lens, ..look_at([5.0, -2.0, 1.0], [0.0, 0.3, 0.1], [0.2, 0.9, -0.3]) }
                .camera()
                .expect("a camera");
            let again = LookAt::of(&camera, 7.0);
            assert!(((again.target - again.eye).length() - 7.0).abs() < 1e-5);
            let again = again.camera().expect("a camera");
            assert_eq!((again.origin, again.orthographic), (camera.origin, camera.orthographic));
            for (again, camera) in
                [(again.right, camera.right), (again.up, camera.up), (again.forward, camera.forward)]
            {
                assert!((again - camera).length() < 2e-6, "{again} {camera}");
            }
        }
    }

    #[test]
    fn a_shifted_lens_looks_straight_ahead() {
        let straight = look_at([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]).camera().expect("a camera");
        let shifted = Camera { forward: straight.forward + 0.7 * straight.right, ..straight };
        let posed = LookAt::of(&shifted, 1.0).camera().expect("a camera");
        assert!((posed.forward - straight.forward).length() < 1e-6);
        assert!((posed.up - straight.up).length() < 1e-6);
    }

    #[test]
    fn a_mirrored_picture_is_turned_the_right_way_round() {
        let right = look_at([1.0, 2.0, 3.0], [0.0; 3], [0.0, 1.0, 0.0]).camera().expect("a camera");
        let mirrored = Camera { right: -right.right, ..right };
        let posed = LookAt::of(&mirrored, 2.0).camera().expect("a camera");
        assert!((posed.forward - right.forward).length() < 1e-6);
        assert!((posed.right - right.right).length() < 1e-6);
    }

    #[test]
    fn what_makes_no_camera_is_refused_by_the_option() {
        let good = look_at([0.0, 0.0, 2.0], [0.0; 3], [0.0, 1.0, 0.0]);
        let lens = |vertical_fov_degrees| LookAt { lens: Lens::Perspective { vertical_fov_degrees }, ..good };
        let ortho = |height| LookAt { lens: Lens::Orthographic { height }, ..good };
        let cases = [
            (LookAt { eye: Vec3::NAN, ..good }, "eye"),
            (LookAt { target: Vec3::splat(f32::INFINITY), ..good }, "target"),
            (LookAt { target: good.eye, ..good }, "target"),
            (LookAt { up: Vec3::NAN, ..good }, "up"),
            (LookAt { up: Vec3::ZERO, ..good }, "up"),
            (LookAt { up: Vec3::NEG_Z, ..good }, "up"),
            (lens(0.0), "fov"),
            (lens(180.0), "fov"),
            (lens(f32::NAN), "fov"),
            (lens(1e-44), "fov"),
            (ortho(0.0), "ortho"),
            (ortho(-1.0), "ortho"),
            (ortho(f32::INFINITY), "ortho"),
        ];
        for (look_at, option) in cases {
            let error = look_at.camera().expect_err("must be refused").to_string();
            assert!(
                error.contains(option) && error.contains("expected") && error.contains("found"),
                "{error}"
            );
        }
    }

    #[test]
    fn extreme_poses_are_finite() {
        for scale in [1e-30_f32, 1e-10, 1.0, 1e10, 1e37] {
            let eye = Vec3::new(1.0, 2.0, -3.0) * scale;
            let camera =
                LookAt { eye, target: -eye, up: Vec3::Y * scale, lens: FOV }.camera().expect("a camera");
            assert!(camera.right.is_finite() && camera.up.is_finite() && camera.forward.is_normalized());
        }
    }
}

//! Position, direction and lens of the camera in `f64`, with the exact motions that change them.

use glam::{DMat3, DQuat, DVec2, DVec3, Vec3};
use glimpse::{Camera, Lens, LookAt};

/// The size and centre of the scene, to which motions are relative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Centre of the scene's bounding box.
    pub center: DVec3,
    /// Longest side of the bounding box.
    pub size: f64,
}

/// Limits of the distance to the target, in longest sides of the scene.
const DISTANCES: [f64; 2] = [1e-4, 1e3];

/// Limits of the scene's longest side, so that products with [`DISTANCES`] are `f32`.
const SIZES: [f64; 2] = [1e-18, 1e18];

/// Limits of the vertical field of view in degrees.
const FOVS: [f32; 2] = [0.01, 179.0];

/// The least angle between view direction and vertical in degrees; beyond the vertical, left and right would be
/// swapped.
const POLE_DEGREES: f64 = 0.5;

impl Extent {
    /// Centre and size of a bounding box; a unit cube for an empty one.
    pub fn of((low, high): (Vec3, Vec3)) -> Self {
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let size = (high - low).max_element();
        let center = 0.5 * (low + high);
        if !(size > 0.0 && size.is_finite() && center.is_finite()) {
            return Self { center: DVec3::ZERO, size: 1.0 };
        }
        let far = DVec3::splat(SIZES[1]);
        Self { center: center.clamp(-far, far), size: size.clamp(SIZES[0], SIZES[1]) }
    }

    fn distance(&self, distance: f64) -> f64 {
        distance.clamp(DISTANCES[0] * self.size, DISTANCES[1] * self.size)
    }

    /// The nearest point within the largest allowed distance from the centre.
    fn place(&self, place: DVec3) -> DVec3 {
        let far = DVec3::splat(DISTANCES[1] * self.size);
        place.clamp(self.center - far, self.center + far)
    }
}

/// An orbit: a target, an eye at a distance from it, and a lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OrbitState {
    /// Centre of the orbit, in world space.
    pub target: DVec3,
    /// Rotation from view space to world space: x is right, y is up, z is backward.
    pub view: DQuat,
    /// Distance between eye and target in world units.
    pub distance: f64,
    /// Projection of the camera.
    pub lens: Lens,
}

/// Clamps a lens to values that a pose can express after rounding to `f32`.
fn believed(lens: Lens, extent: &Extent) -> Lens {
    match lens {
        Lens::Perspective { vertical_fov_degrees } => {
            Lens::Perspective { vertical_fov_degrees: vertical_fov_degrees.clamp(FOVS[0], FOVS[1]) }
        }
        Lens::Orthographic { height } => {
            Lens::Orthographic { height: extent.distance(f64::from(height)) as f32 }
        }
    }
}

impl OrbitState {
    /// The orbit of a camera. The target is the point on the optical axis at the depth of the scene's centre.
    pub fn of(camera: &Camera, extent: &Extent) -> Self {
        // With the origin at zero, the pose's target is the view direction, without rounding by the eye's position.
        let LookAt { target, up, lens, .. } = LookAt::of(&Camera { origin: Vec3::ZERO, ..*camera }, 1.0);
        let eye = extent.place(camera.origin.as_dvec3());
        let forward = target.as_dvec3().normalize_or(DVec3::NEG_Z);
        let right = forward.cross(up.as_dvec3()).normalize_or(forward.any_orthonormal_vector());
        let view = DQuat::from_mat3(&DMat3::from_cols(right, right.cross(forward), -forward)).normalize();
        let abreast = (extent.center - eye).dot(forward);
        let distance = extent.distance(if abreast > 0.0 { abreast } else { 0.5 * extent.size });
        Self { target: eye + forward * distance, view, distance, lens: believed(lens, extent) }
    }

    pub fn right(&self) -> DVec3 {
        self.view * DVec3::X
    }

    pub fn up(&self) -> DVec3 {
        self.view * DVec3::Y
    }

    pub fn forward(&self) -> DVec3 {
        self.view * DVec3::NEG_Z
    }

    pub fn eye(&self) -> DVec3 {
        self.target - self.forward() * self.distance
    }

    /// Height of the picture at the target, in world units.
    pub fn height(&self) -> f64 {
        match self.lens {
            Lens::Perspective { vertical_fov_degrees } => {
                2.0 * self.distance * (0.5 * f64::from(vertical_fov_degrees)).to_radians().tan()
            }
            Lens::Orthographic { height } => f64::from(height),
        }
    }

    /// Point in the target's plane seen at a position, which is in picture heights from the centre.
    fn seen_at(&self, at: DVec2) -> DVec3 {
        self.target + (self.right() * at.x + self.up() * at.y) * self.height()
    }

    /// Rotates around the target by radians about the vertical and about the right axis.
    pub fn orbit(&mut self, by: DVec2) {
        let elevation = self.forward().y.clamp(-1.0, 1.0).asin();
        let most = (90.0 - POLE_DEGREES).to_radians();
        // A camera that starts nearer to the vertical may stay there, but cannot get nearer.
        let pitched = (elevation + by.y).clamp(elevation.min(-most), elevation.max(most));
        let (yaw, pitch) = (DQuat::from_rotation_y(by.x), DQuat::from_rotation_x(pitched - elevation));
        self.view = (yaw * self.view * pitch).normalize();
    }

    /// Rotates around the eye, by the same angles as [`OrbitState::orbit`].
    pub fn turn(&mut self, by: DVec2, extent: &Extent) {
        let eye = self.eye();
        self.orbit(by);
        self.target = extent.place(eye + self.forward() * self.distance);
    }

    /// Translates by a vector in world space.
    pub fn shift(&mut self, by: DVec3, extent: &Extent) {
        self.target = extent.place(self.target + by);
    }

    /// Pans so that the picture moves by `by` picture heights, right and up.
    pub fn pan(&mut self, by: DVec2, extent: &Extent) {
        self.shift((self.right() * by.x + self.up() * by.y) * -self.height(), extent);
    }

    /// Multiplies the distance (or the height of an orthographic picture) by e^exponent; the point seen at `at` stays
    /// fixed.
    pub fn dolly(&mut self, exponent: f64, at: DVec2, extent: &Extent) {
        let (before, held) = (self.height(), self.seen_at(at));
        match &mut self.lens {
            Lens::Perspective { .. } => self.distance = extent.distance(self.distance * exponent.exp()),
            Lens::Orthographic { height } => {
                *height = extent.distance(f64::from(*height) * exponent.exp()) as f32;
            }
        }
        let share = self.height() / before;
        self.target = extent.place(held + (self.target - held) * share);
    }

    /// Moves the target along the optical axis to the depth of a point, without changing the picture; returns the
    /// vector in world space from the target to the point.
    pub fn reach(&mut self, point: DVec3, extent: &Extent) -> DVec3 {
        let eye = self.eye();
        let depth = (point - eye).dot(self.forward());
        if depth > 0.0 {
            self.distance = extent.distance(depth);
            self.target = eye + self.forward() * self.distance;
        }
        extent.place(point) - self.target
    }

    /// Interpolates to another state, `share` from 0 to 1. A lens of another kind is replaced immediately.
    pub fn towards(&self, end: &Self, share: f64) -> Self {
        let between =
            |from: f32, to: f32| (f64::from(from) + (f64::from(to) - f64::from(from)) * share) as f32;
        let lens = match (self.lens, end.lens) {
            (
                Lens::Perspective { vertical_fov_degrees: from },
                Lens::Perspective { vertical_fov_degrees: to },
            ) => Lens::Perspective { vertical_fov_degrees: between(from, to) },
            (Lens::Orthographic { height: from }, Lens::Orthographic { height: to }) => {
                Lens::Orthographic { height: between(from, to) }
            }
            _ => end.lens,
        };
        Self {
            target: self.target.lerp(end.target, share),
            view: self.view.slerp(end.view, share).normalize(),
            distance: self.distance * (end.distance / self.distance).powf(share),
            lens,
        }
    }

    /// The pose for the command line. The target of a pose only gives a direction: it is at least as far from the eye
    /// as the eye is from the origin, so that rounding does not rotate the view.
    pub fn look_at(&self) -> LookAt {
        let eye = self.eye();
        let ahead = self.distance.max(eye.length());
        LookAt {
            eye: eye.as_vec3(),
            target: (eye + self.forward() * ahead).as_vec3(),
            up: self.up().as_vec3(),
            lens: self.lens,
        }
    }
}

//! Where the camera stands, in `f64`: what moves it, exactly.

use glam::{DMat3, DQuat, DVec2, DVec3, Vec3};
use glimpse::{Camera, Lens, Pose};

/// What the size of a step is measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    /// Middle of the scene.
    pub center: DVec3,
    /// Its longest side.
    pub size: f64,
}

/// The least and the largest distance from the target, in longest sides of the scene.
const DISTANCES: [f64; 2] = [1e-4, 1e3];

/// The least and the largest side of a scene that is believed: their products with [`DISTANCES`] are `f32`.
const SIZES: [f64; 2] = [1e-18, 1e18];

/// The least and the largest vertical field of view in degrees.
const FOVS: [f32; 2] = [0.01, 179.0];

/// The view stays so many degrees off the vertical, where left and right would change sides.
const POLE_DEGREES: f64 = 0.5;

impl Extent {
    /// Of a box. One that holds nothing is a unit cube.
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

    /// The nearest place within the largest distance from the middle.
    fn place(&self, place: DVec3) -> DVec3 {
        let far = DVec3::splat(DISTANCES[1] * self.size);
        place.clamp(self.center - far, self.center + far)
    }
}

/// An eye at a distance from its target, with a lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stance {
    /// What the camera turns around.
    pub target: DVec3,
    /// World from view: right, up and backward are its x, y and z.
    pub view: DQuat,
    /// From the eye to the target, in world units.
    pub distance: f64,
    /// The lens.
    pub lens: Lens,
}

/// A lens that a pose can say after rounding.
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

impl Stance {
    /// Of a camera, with the target in the middle of the picture where the middle of the scene is abreast of it.
    pub fn of(camera: &Camera, extent: &Extent) -> Self {
        // From the origin: the target is then the view direction, unrounded by the eye.
        let Pose { target, up, lens, .. } = Pose::of(&Camera { origin: Vec3::ZERO, ..*camera }, 1.0);
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

    /// World units from the lower to the upper edge of the picture, at the target.
    pub fn height(&self) -> f64 {
        match self.lens {
            Lens::Perspective { vertical_fov_degrees } => {
                2.0 * self.distance * (0.5 * f64::from(vertical_fov_degrees)).to_radians().tan()
            }
            Lens::Orthographic { height } => f64::from(height),
        }
    }

    /// The place in the plane of the target that is seen there, in picture heights from the middle.
    fn seen_at(&self, at: DVec2) -> DVec3 {
        self.target + (self.right() * at.x + self.up() * at.y) * self.height()
    }

    /// The orbit: turns around the target by radians, about the vertical and about the right.
    pub fn orbit(&mut self, by: DVec2) {
        let elevation = self.forward().y.clamp(-1.0, 1.0).asin();
        let most = (90.0 - POLE_DEGREES).to_radians();
        // A camera that is nearer to the vertical from the start may stay there, but gets no nearer.
        let pitched = (elevation + by.y).clamp(elevation.min(-most), elevation.max(most));
        let (yaw, pitch) = (DQuat::from_rotation_y(by.x), DQuat::from_rotation_x(pitched - elevation));
        self.view = (yaw * self.view * pitch).normalize();
    }

    /// As [`Stance::orbit`], around the eye.
    pub fn turn(&mut self, by: DVec2, extent: &Extent) {
        let eye = self.eye();
        self.orbit(by);
        self.target = extent.place(eye + self.forward() * self.distance);
    }

    /// Moves by that much in the world.
    pub fn shift(&mut self, by: DVec3, extent: &Extent) {
        self.target = extent.place(self.target + by);
    }

    /// Moves the picture by so many of its heights, right and up.
    pub fn pan(&mut self, by: DVec2, extent: &Extent) {
        self.shift((self.right() * by.x + self.up() * by.y) * -self.height(), extent);
    }

    /// Multiplies the distance (or what parallel rays show) by e to the power of that; what is seen at `at` stays there.
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

    /// The same picture with the target abreast of a point; what is left to the point, in the world.
    pub fn reach(&mut self, point: DVec3, extent: &Extent) -> DVec3 {
        let eye = self.eye();
        let depth = (point - eye).dot(self.forward());
        if depth > 0.0 {
            self.distance = extent.distance(depth);
            self.target = eye + self.forward() * self.distance;
        }
        extent.place(point) - self.target
    }

    /// So much of the way to another one, 0 to 1. A lens of another kind is changed at once.
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

    /// As the command line says it. The target of a pose gives a direction alone: it is no nearer than the eye is to the
    /// origin, so that rounding of a near one does not turn the view.
    pub fn pose(&self) -> Pose {
        let eye = self.eye();
        let ahead = self.distance.max(eye.length());
        Pose {
            eye: eye.as_vec3(),
            target: (eye + self.forward() * ahead).as_vec3(),
            up: self.up().as_vec3(),
            lens: self.lens,
        }
    }
}

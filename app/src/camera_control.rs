//! Interactive camera: orbit, pan, dolly and flight, with damping that is independent of the frame rate.

mod damping;
mod orbit_state;
#[cfg(test)]
mod tests;

use std::time::Duration;

use glam::{DVec2, DVec3, Vec2, Vec3};
use glimpse::{Camera, Lens, LookAt};

use self::{
    damping::{Damped, Flight, RATE},
    orbit_state::{Extent, OrbitState},
};
use crate::{Motion, Navigation};

/// A camera moved by user input.
///
/// [`CameraControl::apply`] takes motions; [`CameraControl::advance`] carries them out, with a lag of about
/// 60 ms. Until the first motion the camera is the scene's own, bit for bit, which may have properties that
/// no [`LookAt`] has (a shifted lens, a mirrored picture); from then on it is that of a pose.
#[derive(Clone, Debug)]
pub struct CameraControl {
    extent: Extent,
    /// Camera of the scene chosen last.
    base: Camera,
    orbit_state: OrbitState,
    /// Whether the camera differs from `base`.
    moved: bool,
    /// Animation back to `base`: the state where it began, and the remaining share.
    glide: Option<(OrbitState, f64)>,
    /// Rotation: yaw and pitch in radians.
    turn: Damped,
    /// Translation parallel to the picture, in picture heights right and up.
    pan: Damped,
    /// Translation in world units.
    slide: Damped,
    /// Change of the logarithm of the distance to the target.
    dolly: Damped,
    /// The position that a dolly keeps fixed, in picture heights from the centre.
    held: DVec2,
    /// Flight velocity right, up and forward, in longest sides of the scene a second.
    flight: Flight,
    /// Natural logarithm of the factor on the flying speed.
    speed_exponent: f64,
    navigation: Navigation,
}

/// Flying speed before it is changed, in longest sides of the scene a second.
const FLIGHT: f64 = 0.25;

/// The limit of the exponent of the flying speed: 400 times faster or slower.
const MAX_SPEED_EXPONENT: f64 = 6.0;

/// Rotation of the orbit for a drag over the height of the picture.
const ORBIT_RADIANS: f64 = std::f64::consts::PI;

/// Limit of a motion per frame, in picture heights or exponents: faulty devices report larger ones.
const LARGEST: f32 = 100.0;

/// Step in seconds in which motions that depend on each other are integrated alternately.
const TURN_TAKING: f64 = 1.0 / 240.0;

/// Limit of the time between two frames in seconds: after a longer one, the program was suspended.
const LONGEST: f64 = 1.0;

/// Remaining share at which the animation to a scene's camera jumps to its end.
const ARRIVED: f64 = 1e-6;

impl CameraControl {
    /// Creates the control for the scene's first camera; `bounds` are the lowest and highest corner of the scene.
    #[must_use]
    pub fn new(home: Camera, bounds: (Vec3, Vec3)) -> Self {
        let extent = Extent::of(bounds);
        Self {
            extent,
            base: home,
            orbit_state: OrbitState::of(&home, &extent),
            moved: false,
            glide: None,
            turn: Damped::default(),
            pan: Damped::default(),
            slide: Damped::default(),
            dolly: Damped::default(),
            held: DVec2::ZERO,
            flight: Flight::default(),
            speed_exponent: 0.0,
            navigation: Navigation::Orbit,
        }
    }

    /// The control with the camera moved to the pose of another one at once.
    #[must_use]
    pub fn moved_to(self, camera: &Camera) -> Self {
        Self { orbit_state: OrbitState::of(camera, &self.extent), moved: true, ..self }
    }

    /// Takes a motion. Values that are not finite are ignored. For [`Motion::Focus`] call [`CameraControl::focus`]
    /// instead, which takes the surface point.
    pub fn apply(&mut self, motion: Motion, navigation: Navigation) {
        self.navigation = navigation;
        match motion {
            Motion::Turn { by } => self.turn.ask(self.turned(sound(by)).extend(0.0)),
            Motion::Pan { by } => self.pan.ask(sound(by).extend(0.0)),
            Motion::Dolly { by, at } => {
                self.held = at.map_or(DVec2::ZERO, sound);
                self.dolly.ask(DVec3::X * -sound(Vec2::X * by).x);
            }
            Motion::Fly { along } => {
                let along = if along.is_finite() { along.clamp_length_max(1.0) } else { Vec3::ZERO };
                self.flight.ask(along.as_dvec3() * self.speed());
            }
            Motion::FlySpeed { by } => {
                self.speed_exponent = (self.speed_exponent + sound(Vec2::X * by).x)
                    .clamp(-MAX_SPEED_EXPONENT, MAX_SPEED_EXPONENT)
            }
            Motion::Focus { .. } => return,
        }
        if self.is_steered() {
            self.glide = None;
        }
    }

    /// Moves the orbit's centre to a point in world space: the camera is translated parallel to its picture until the
    /// point is at the centre, and keeps its distance and direction.
    pub fn focus(&mut self, point: Vec3) {
        if !point.is_finite() {
            return;
        }
        self.glide = None;
        self.moved = true;
        self.slide.stop();
        let way = self.orbit_state.reach(point.as_dvec3(), &self.extent);
        self.slide.ask(way);
    }

    /// Returns to the camera that was chosen last, initially the one of [`CameraControl::new`].
    pub fn reset(&mut self) {
        self.go_to(self.base);
    }

    /// Moves smoothly to one of the scene's cameras; once it is reached, [`CameraControl::camera`] returns it bit for
    /// bit.
    pub fn go_to(&mut self, camera: Camera) {
        for movement in [&mut self.turn, &mut self.pan, &mut self.slide, &mut self.dolly] {
            movement.stop();
        }
        self.flight = Flight::default();
        let is_there = !self.moved && camera == self.base;
        self.base = camera;
        self.moved |= !is_there;
        self.glide = (!is_there).then_some((self.orbit_state, 1.0));
    }

    /// Advances the motions by a time.
    pub fn advance(&mut self, time: Duration) {
        let seconds = time.as_secs_f64().min(LONGEST);
        if seconds == 0.0 || !self.is_moving() {
            return;
        }
        self.moved = true;
        self.advance_glide(seconds);
        if self.is_steered() {
            self.advance_steered(seconds);
        }
    }

    /// Whether the next frame will differ from this one. Becomes false within a finite time without input.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.glide.is_some() || self.is_steered()
    }

    /// Current camera.
    #[must_use]
    pub fn camera(&self) -> Camera {
        // The conversion cannot fail, as the values of an orbit state are bounded.
        if self.moved { self.orbit_state.look_at().camera().unwrap_or(self.base) } else { self.base }
    }

    /// Options of the command line for exactly this camera: `--eye=X,Y,Z --target=X,Y,Z --up=X,Y,Z` with
    /// `--fov=DEGREES` or `--ortho=HEIGHT`, in the coordinates of a file where the scene's origin is at `origin`; `None`
    /// while it is the scene's camera that was chosen last.
    #[must_use]
    pub fn command_line(&self, origin: DVec3) -> Option<String> {
        let triple = |v: Vec3| format!("{},{},{}", v.x, v.y, v.z);
        let point = |v: Vec3| {
            if origin == DVec3::ZERO {
                return triple(v);
            }
            let v = v.as_dvec3() + origin;
            format!("{},{},{}", v.x, v.y, v.z)
        };
        self.moved.then(|| {
            let LookAt { eye, target, up, lens } = self.orbit_state.look_at();
            let lens = match lens {
                Lens::Perspective { vertical_fov_degrees } => format!("--fov={vertical_fov_degrees}"),
                Lens::Orthographic { height } => format!("--ortho={height}"),
            };
            format!("--eye={} --target={} --up={} {lens}", point(eye), point(target), triple(up))
        })
    }

    /// Whether a motion other than the animation to `base` is in progress.
    fn is_steered(&self) -> bool {
        let damped = [&self.turn, &self.pan, &self.slide, &self.dolly];
        damped.into_iter().any(Damped::is_moving) || self.flight.is_moving()
    }

    /// Flying speed in longest sides of the scene a second.
    fn speed(&self) -> f64 {
        FLIGHT * self.speed_exponent.exp()
    }

    /// Converts a drag in picture heights into radians of yaw and pitch. In orbit, the near side follows the hand; in
    /// flight, the centre of the picture does.
    fn turned(&self, by: DVec2) -> DVec2 {
        match (self.navigation, self.orbit_state.lens) {
            (Navigation::Orbit, _) | (Navigation::Fly, Lens::Orthographic { .. }) => {
                DVec2::new(-by.x, by.y) * ORBIT_RADIANS
            }
            (Navigation::Fly, Lens::Perspective { vertical_fov_degrees }) => {
                DVec2::new(by.x, -by.y) * f64::from(vertical_fov_degrees).to_radians()
            }
        }
    }

    fn advance_glide(&mut self, seconds: f64) {
        let Some((start, left)) = self.glide else { return };
        let left = left * (-RATE * 0.5 * seconds).exp();
        if left < ARRIVED {
            self.glide = None;
            self.orbit_state = OrbitState::of(&self.base, &self.extent);
            self.moved = false;
        } else {
            self.glide = Some((start, left));
            self.orbit_state = start.towards(&OrbitState::of(&self.base, &self.extent), 1.0 - left);
        }
    }

    fn advance_steered(&mut self, seconds: f64) {
        for movement in [&mut self.turn, &mut self.pan, &mut self.slide, &mut self.dolly] {
            movement.begin(seconds);
        }
        let parts = (seconds / TURN_TAKING).ceil();
        for _ in 0..parts as u32 {
            let part = seconds / parts;
            let [turn, pan, slide, dolly] = [&mut self.turn, &mut self.pan, &mut self.slide, &mut self.dolly]
                .map(|movement| movement.advance(part));
            let flown = self.flight.advance(part);
            self.carry_out(turn, pan, slide, dolly);
            self.fly(flown);
        }
        let (turn, pan) = (self.turn.settle(1.0), self.pan.settle(1.0));
        let (slide, dolly) = (self.slide.settle(self.orbit_state.height()), self.dolly.settle(1.0));
        self.carry_out(turn, pan, slide, dolly);
        self.flight.settle(self.speed());
    }

    fn carry_out(&mut self, turn: DVec3, pan: DVec3, slide: DVec3, dolly: DVec3) {
        match self.navigation {
            Navigation::Orbit => self.orbit_state.orbit(turn.truncate()),
            Navigation::Fly => self.orbit_state.turn(turn.truncate(), &self.extent),
        }
        self.orbit_state.dolly(dolly.x, self.held, &self.extent);
        self.orbit_state.pan(pan.truncate(), &self.extent);
        self.orbit_state.shift(slide, &self.extent);
    }

    fn fly(&mut self, along: DVec3) {
        let (right, up, forward) =
            (self.orbit_state.right(), self.orbit_state.up(), self.orbit_state.forward());
        let way = right * along.x + up * along.y + forward * along.z;
        self.orbit_state.shift(way * self.extent.size, &self.extent);
    }
}

/// Converts to `f64` and clamps what a faulty device may report.
fn sound(by: Vec2) -> DVec2 {
    if by.is_finite() {
        by.clamp(Vec2::splat(-LARGEST), Vec2::splat(LARGEST)).as_dvec2()
    } else {
        DVec2::ZERO
    }
}

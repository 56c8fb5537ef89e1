//! The camera in a person's hand: orbit, pan, dolly, fly, with smooth damping that knows no frame rate.

mod damping;
mod stance;
#[cfg(test)]
mod tests;

use std::time::Duration;

use glam::{DVec2, DVec3, Vec2, Vec3};
use glimpse::{Camera, Lens, Pose};

use self::{
    damping::{Damped, Flight, RATE},
    stance::{Extent, Stance},
};
use crate::{Motion, Navigation};

/// A camera that is moved.
///
/// Motions are asked for with [`CameraControl::apply`] and done by [`CameraControl::advance`], with a lag of about 60 ms.
/// While nothing was moved the camera is the scene's own, bit for bit, which may hold what no [`Pose`] says (a shifted
/// lens, a mirrored picture); from the first motion on it is that of a pose.
#[derive(Clone, Debug)]
pub struct CameraControl {
    extent: Extent,
    /// The scene's camera that was gone to last.
    base: Camera,
    stance: Stance,
    /// The stance is not that of the base.
    moved: bool,
    /// The way back to the base: where it began and how much of it is left.
    glide: Option<(Stance, f64)>,
    /// Yaw and pitch in radians.
    turn: Damped,
    /// Picture heights, right and up.
    pan: Damped,
    /// World units.
    slide: Damped,
    /// Exponent of the distance.
    dolly: Damped,
    /// What a dolly holds in place.
    held: DVec2,
    /// Longest sides of the scene per second, right, up and forward.
    flight: Flight,
    /// Exponent of the flying speed.
    haste: f64,
    navigation: Navigation,
}

/// Flying speed in longest sides of the scene per second, while nobody changed it.
const FLIGHT: f64 = 0.25;

/// The largest exponent by which people change the flying speed: 400 times faster or slower.
const HASTE: f64 = 6.0;

/// A drag over the height of the picture turns the orbit by as much.
const ORBIT_RADIANS: f64 = std::f64::consts::PI;

/// No motion between two frames is larger, in picture heights or exponents: a faulty device reports such.
const LARGEST: f32 = 100.0;

/// Movements that depend on each other take turns this often, in seconds.
const TURN_TAKING: f64 = 1.0 / 240.0;

/// A frame that took longer counts as having taken so many seconds: the program was asleep.
const LONGEST: f64 = 1.0;

/// The part of the way to a scene's camera that is done at once.
const ARRIVED: f64 = 1e-6;

impl CameraControl {
    /// With the scene's camera and the box around the scene.
    #[must_use]
    pub fn new(home: Camera, bounds: (Vec3, Vec3)) -> Self {
        let extent = Extent::of(bounds);
        Self {
            extent,
            base: home,
            stance: Stance::of(&home, &extent),
            moved: false,
            glide: None,
            turn: Damped::default(),
            pan: Damped::default(),
            slide: Damped::default(),
            dolly: Damped::default(),
            held: DVec2::ZERO,
            flight: Flight::default(),
            haste: 0.0,
            navigation: Navigation::Orbit,
        }
    }

    /// Asks for a motion. Numbers that are not finite ask for nothing. [`Motion::Focus`] is for
    /// [`CameraControl::focus`], which needs the surface.
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
            Motion::Haste { by } => self.haste = (self.haste + sound(Vec2::X * by).x).clamp(-HASTE, HASTE),
            Motion::Focus { .. } => return,
        }
        if self.is_steered() {
            self.glide = None;
        }
    }

    /// Brings the orbit's centre to a point of the world: the camera slides until it is in the middle of the picture,
    /// without turning and without coming nearer to it.
    pub fn focus(&mut self, point: Vec3) {
        if !point.is_finite() {
            return;
        }
        self.glide = None;
        self.moved = true;
        self.slide.stop();
        let way = self.stance.reach(point.as_dvec3(), &self.extent);
        self.slide.ask(way);
    }

    /// Back to the camera that was gone to last, at first the one of [`CameraControl::new`].
    pub fn reset(&mut self) {
        self.go_to(self.base);
    }

    /// To one of the scene's cameras, smoothly; [`CameraControl::camera`] is it, bit for bit, once it is reached.
    pub fn go_to(&mut self, camera: Camera) {
        for movement in [&mut self.turn, &mut self.pan, &mut self.slide, &mut self.dolly] {
            movement.stop();
        }
        self.flight = Flight::default();
        let is_there = !self.moved && camera == self.base;
        self.base = camera;
        self.moved |= !is_there;
        self.glide = (!is_there).then_some((self.stance, 1.0));
    }

    /// Lets time pass.
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

    /// Whether the next frame differs: false for good after a finite time without motions.
    #[must_use]
    pub fn is_moving(&self) -> bool {
        self.glide.is_some() || self.is_steered()
    }

    /// The camera of this moment.
    #[must_use]
    pub fn camera(&self) -> Camera {
        // A stance always makes a camera: its numbers are bounded.
        if self.moved { self.stance.pose().camera().unwrap_or(self.base) } else { self.base }
    }

    /// Options of the command line that make this very camera, `--eye=X,Y,Z --target=X,Y,Z --up=X,Y,Z` with `--fov=DEGREES`
    /// or `--ortho=HEIGHT`; `None` while it is the scene's camera that was gone to last.
    #[must_use]
    pub fn command_line(&self) -> Option<String> {
        let triple = |v: Vec3| format!("{},{},{}", v.x, v.y, v.z);
        self.moved.then(|| {
            let Pose { eye, target, up, lens } = self.stance.pose();
            let lens = match lens {
                Lens::Perspective { vertical_fov_degrees } => format!("--fov={vertical_fov_degrees}"),
                Lens::Orthographic { height } => format!("--ortho={height}"),
            };
            format!("--eye={} --target={} --up={} {lens}", triple(eye), triple(target), triple(up))
        })
    }

    /// Something but the way to the base moves.
    fn is_steered(&self) -> bool {
        let damped = [&self.turn, &self.pan, &self.slide, &self.dolly];
        damped.into_iter().any(Damped::is_moving) || self.flight.is_moving()
    }

    /// Flying speed in longest sides of the scene per second.
    fn speed(&self) -> f64 {
        FLIGHT * self.haste.exp()
    }

    /// Radians of yaw and pitch for a drag by picture heights: what is near of the orbit follows the hand, and what a flying
    /// eye looks at.
    fn turned(&self, by: DVec2) -> DVec2 {
        match (self.navigation, self.stance.lens) {
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
            self.stance = Stance::of(&self.base, &self.extent);
            self.moved = false;
        } else {
            self.glide = Some((start, left));
            self.stance = start.towards(&Stance::of(&self.base, &self.extent), 1.0 - left);
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
        let (slide, dolly) = (self.slide.settle(self.stance.height()), self.dolly.settle(1.0));
        self.carry_out(turn, pan, slide, dolly);
        self.flight.settle(self.speed());
    }

    fn carry_out(&mut self, turn: DVec3, pan: DVec3, slide: DVec3, dolly: DVec3) {
        match self.navigation {
            Navigation::Orbit => self.stance.orbit(turn.truncate()),
            Navigation::Fly => self.stance.turn(turn.truncate(), &self.extent),
        }
        self.stance.dolly(dolly.x, self.held, &self.extent);
        self.stance.pan(pan.truncate(), &self.extent);
        self.stance.shift(slide, &self.extent);
    }

    fn fly(&mut self, along: DVec3) {
        let (right, up, forward) = (self.stance.right(), self.stance.up(), self.stance.forward());
        let way = right * along.x + up * along.y + forward * along.z;
        self.stance.shift(way * self.extent.size, &self.extent);
    }
}

/// What a device may report, in `f64`.
fn sound(by: Vec2) -> DVec2 {
    if by.is_finite() {
        by.clamp(Vec2::splat(-LARGEST), Vec2::splat(LARGEST)).as_dvec2()
    } else {
        DVec2::ZERO
    }
}

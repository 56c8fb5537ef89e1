//! Exponentially damped motion, independent of the frame rate.

use glam::DVec3;

/// Decay rate of the remaining motion in 1/s: 63 % is done within 60 ms, 99.9 % within 0.4 s.
pub(super) const RATE: f64 = 17.0;

/// Remainders below this, in picture heights or radians, are carried out immediately: they are far less than
/// a pixel.
const SETTLED: f64 = 1e-5;

/// A motion that follows its input with an exponentially decaying lag.
///
/// Input since the last step is treated as evenly distributed over the step, and the differential equation is solved
/// exactly, so that the result does not depend on the steps.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Damped {
    /// Input from earlier steps that has not been carried out.
    owed: DVec3,
    /// Input of this step per second.
    slope: DVec3,
    /// Input since the last step.
    asked: DVec3,
}

impl Damped {
    pub fn ask(&mut self, by: DVec3) {
        self.asked += by;
    }

    pub fn stop(&mut self) {
        *self = Self::default();
    }

    pub fn is_moving(&self) -> bool {
        self.owed != DVec3::ZERO || self.asked != DVec3::ZERO
    }

    /// Begins a step of that many seconds.
    pub fn begin(&mut self, seconds: f64) {
        self.slope = std::mem::take(&mut self.asked) / seconds;
    }

    /// Advances by a part of the step; returns the motion to carry out.
    pub fn advance(&mut self, seconds: f64) -> DVec3 {
        let lag = self.slope / RATE;
        let left = lag + (self.owed - lag) * (-RATE * seconds).exp();
        let done = self.owed + self.slope * seconds - left;
        self.owed = left;
        done
    }

    /// Ends the step; returns the remaining motion if it is negligible, else zero. `unit` converts picture
    /// heights or radians into the unit of the motion.
    pub fn settle(&mut self, unit: f64) -> DVec3 {
        let at_rest = self.slope == DVec3::ZERO && self.owed.length() < SETTLED * unit;
        if at_rest { std::mem::take(&mut self.owed) } else { DVec3::ZERO }
    }
}

/// A velocity that follows its input with an exponentially decaying lag.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flight {
    now: DVec3,
    asked: DVec3,
}

impl Flight {
    /// Sets the target velocity until the next step.
    pub fn ask(&mut self, velocity: DVec3) {
        self.asked = velocity;
    }

    pub fn is_moving(&self) -> bool {
        self.now != DVec3::ZERO || self.asked != DVec3::ZERO
    }

    /// Advances by a part of the step; returns the displacement.
    pub fn advance(&mut self, seconds: f64) -> DVec3 {
        let decay = (-RATE * seconds).exp();
        let behind = self.now - self.asked;
        self.now = self.asked + behind * decay;
        self.asked * seconds + behind * ((1.0 - decay) / RATE)
    }

    /// Ends the step: a negligible velocity becomes zero. `unit` is the velocity that speeds are compared with.
    pub fn settle(&mut self, unit: f64) {
        if std::mem::take(&mut self.asked) == DVec3::ZERO && self.now.length() < SETTLED * unit {
            self.now = DVec3::ZERO;
        }
    }
}

//! Motion that comes to rest, the same at every frame rate.

use glam::DVec3;

/// How fast what is owed is paid, in 1/s: 63 % within 60 ms, all but a thousandth within 0.4 s.
pub(super) const RATE: f64 = 17.0;

/// What is owed at most when everything is paid at once: far below a pixel, in picture heights or radians.
const SETTLED: f64 = 1e-5;

/// A movement that was asked for and is done with a lag that decays exponentially.
///
/// What was asked for since the last step counts as having come evenly during the step: the movement then solves the
/// differential equation exactly, whatever the steps are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Damped {
    /// Asked for before this step and not done.
    owed: DVec3,
    /// Asked for in this step, per second.
    slope: DVec3,
    /// Asked for since the last step.
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

    /// A step of that many seconds begins.
    pub fn begin(&mut self, seconds: f64) {
        self.slope = std::mem::take(&mut self.asked) / seconds;
    }

    /// What is to be done in a part of the step.
    pub fn advance(&mut self, seconds: f64) -> DVec3 {
        let lag = self.slope / RATE;
        let left = lag + (self.owed - lag) * (-RATE * seconds).exp();
        let done = self.owed + self.slope * seconds - left;
        self.owed = left;
        done
    }

    /// The step is over: what else is to be done, where next to nothing is left. `unit` is what one is worth.
    pub fn settle(&mut self, unit: f64) -> DVec3 {
        let at_rest = self.slope == DVec3::ZERO && self.owed.length() < SETTLED * unit;
        if at_rest { std::mem::take(&mut self.owed) } else { DVec3::ZERO }
    }
}

/// A speed that follows what is asked for with a lag that decays exponentially.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flight {
    now: DVec3,
    asked: DVec3,
}

impl Flight {
    /// The velocity that is asked for until the next step.
    pub fn ask(&mut self, velocity: DVec3) {
        self.asked = velocity;
    }

    pub fn is_moving(&self) -> bool {
        self.now != DVec3::ZERO || self.asked != DVec3::ZERO
    }

    /// The way in a part of the step.
    pub fn advance(&mut self, seconds: f64) -> DVec3 {
        let decay = (-RATE * seconds).exp();
        let behind = self.now - self.asked;
        self.now = self.asked + behind * decay;
        self.asked * seconds + behind * ((1.0 - decay) / RATE)
    }

    /// The step is over. `unit` is the velocity of which a speed is measured.
    pub fn settle(&mut self, unit: f64) {
        if std::mem::take(&mut self.asked) == DVec3::ZERO && self.now.length() < SETTLED * unit {
            self.now = DVec3::ZERO;
        }
    }
}

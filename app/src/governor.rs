//! The governor holds a frame time by lowering resolution, raising the block size and relaxing tolerances, without
//! visible oscillation.
//!
//! It estimates the cost of the scene from finished frames: each report is converted into the time per pixel
//! at the best level, of which each level takes a known share. It lowers the level immediately, as far as
//! needed, and raises it one step at a time, once even the slowest recent frame would have fitted at the
//! better level for a while. A level that was tried and left again is not retried until frames become cheaper
//! or a waiting time has passed, which doubles with each failure; so a constant load settles.

mod ladder;
#[cfg(test)]
mod tests;

use std::{collections::VecDeque, time::Duration};

use self::ladder::LADDER;
pub use self::ladder::Quality;

/// The time of a finished frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameReport {
    /// [`Quality::level`] of the frame. Reports of frames at rest are ignored, as they have no time limit.
    pub level: Option<usize>,
    /// Number of pixels of the frame.
    pub pixels: u64,
    /// Time of the work in milliseconds, without waiting for the display; measured on the device where it has
    /// timestamps.
    pub ms: f64,
}

/// The level before any frame was timed: a quarter of the pixels.
const FIRST: usize = 5;

/// The level is raised if the slowest of the last frames would have taken at most this share of the limit there.
const ROOM: f64 = 0.93;

/// The level is lowered to one where the frame that was too slow would have taken at most this share of the limit.
const SAFE: f64 = 0.88;

/// A frame slower than expected by this factor is an outlier, caused by something else, unless the next is slow too.
const HICCUP: f64 = 1.7;

/// Time for which frames must have fitted at the better level before the level is raised.
const OBSERVATION: Duration = Duration::from_millis(1000);

/// Shorter time that applies if frames would take less than half of the limit there, as after a demanding
/// scene.
const HURRY: Duration = Duration::from_millis(250);

/// Raising the level has failed if it is lowered again within this time.
const TRIAL: Duration = Duration::from_secs(5);

/// Time for which a failed level is not retried: initial value and maximum, as it doubles with each failure.
const PENANCE: [Duration; 2] = [Duration::from_secs(20), Duration::from_secs(160)];

/// If the cost falls below this share, the load is new and failed levels may be retried.
const CHEAPER: f64 = 0.85;

/// Time for which the camera must have been at rest before a frame at full quality is rendered.
const REST: Duration = Duration::from_millis(200);

/// A level that was tried and failed.
#[derive(Clone, Copy, Debug)]
struct FailedAttempt {
    level: usize,
    /// Cost of a pixel at the best level when the level was tried, in ms.
    cost: f64,
    until: Duration,
    penance: Duration,
}

/// Chooses the quality of each frame.
///
/// A new level changes the frame's size, and thus its targets; between levels 4 and 5 also the block size, and thus its
/// kernels. Callers should keep both, and create them ahead of the frame where that is slow.
#[derive(Clone, Debug)]
pub struct Governor {
    budget_ms: f64,
    thermal: f64,
    /// Largest scale of any frame.
    largest: f32,
    level: usize,
    /// Time at which the level was chosen.
    since: Duration,
    /// Cost of a pixel at the best level when this level was raised to, in ms; `None` where it was lowered to.
    climbed: Option<f64>,
    failed_attempt: Option<FailedAttempt>,
    /// Pixels of the view, derived from reports.
    view: f64,
    /// Times of the last frames and their costs of a pixel at the best level, in ms.
    costs: VecDeque<(Duration, f64)>,
    /// Whether the last frame may have been an outlier.
    doubtful: bool,
    /// Time of the camera's last motion.
    moved: Option<Duration>,
}

impl Governor {
    /// Creates a governor for a frame time in milliseconds.
    #[must_use]
    pub fn new(budget_ms: f64) -> Self {
        Self {
            budget_ms,
            thermal: 1.0,
            largest: 1.0,
            level: FIRST,
            since: Duration::ZERO,
            climbed: None,
            failed_attempt: None,
            view: 0.0,
            costs: VecDeque::new(),
            doubtful: false,
            moved: None,
        }
    }

    /// Sets the frame time in milliseconds.
    pub fn set_budget(&mut self, budget_ms: f64) {
        if budget_ms != self.budget_ms {
            self.budget_ms = budget_ms;
            self.failed_attempt = None;
        }
    }

    /// Sets the usable share of the frame time: 1 while the device is cool, less so that a hot device does
    /// not lower its clocks. Clamped to 0.1 to 1; values that are not finite are ignored.
    pub fn set_thermal(&mut self, factor: f32) {
        if factor.is_finite() {
            self.thermal = f64::from(factor).clamp(0.1, 1.0);
        }
    }

    /// Halves the largest scale of moving frames and of frames at rest, down to the scale of the last level, to use
    /// less memory. The effect adds up over calls, and stays for the life of the governor.
    pub fn trim(&mut self) {
        self.largest = (0.5 * self.largest).max(LADDER[LADDER.len() - 1].scale);
        self.level = self.level.max(self.best());
    }

    /// Quality of the frame rendered at `now`, on any monotonic clock. `last` is the report of a frame
    /// finished since the last call; `moving` tells whether the camera or anything else changes. Until the
    /// first motion, the camera counts as at rest.
    pub fn next(&mut self, now: Duration, last: Option<FrameReport>, moving: bool) -> Quality {
        if moving {
            self.moved = Some(now);
        }
        if let Some(cost) = last.and_then(|report| self.cost(&report)) {
            self.learn(now, cost);
        }
        if self.moved.is_none_or(|moved| now.saturating_sub(moved) >= REST) {
            // Waiting to raise the level starts with the next motion.
            self.since = now;
            Quality { level: None, scale: self.largest, block: 2, relax: 1.0 }
        } else {
            let level = &LADDER[self.level];
            Quality { level: Some(self.level), scale: level.scale, block: level.block, relax: level.relax }
        }
    }

    /// Largest scale of any frame: 1 unless memory was scarce.
    #[must_use]
    pub fn largest(&self) -> f32 {
        self.largest
    }

    /// Time limit of a frame in milliseconds.
    #[must_use]
    pub fn limit_ms(&self) -> f64 {
        self.budget_ms * self.thermal
    }

    /// Cost of a pixel at the best level, in ms, derived from a report; `None` for a frame at rest or without a time.
    fn cost(&mut self, report: &FrameReport) -> Option<f64> {
        let level = LADDER.get(report.level?)?;
        let cost = report.ms / (report.pixels as f64 * level.work);
        if !(report.pixels > 0 && cost.is_finite() && cost > 0.0) {
            return None;
        }
        self.view = report.pixels as f64 / level.area();
        Some(cost)
    }

    /// Time in ms of a frame of a level, given the cost of a pixel at the best level.
    fn time(&self, level: usize, cost: f64) -> f64 {
        cost * self.view * LADDER[level].share()
    }

    /// The largest cost of the last frames.
    fn worst(&self) -> f64 {
        self.costs.iter().map(|&(_, cost)| cost).fold(0.0, f64::max)
    }

    /// The best level whose scale is allowed.
    fn best(&self) -> usize {
        LADDER.iter().position(|level| level.scale <= self.largest).unwrap_or(LADDER.len() - 1)
    }

    fn learn(&mut self, now: Duration, cost: f64) {
        let too_slow = self.time(self.level, cost) > self.limit_ms();
        if too_slow && !self.doubtful && !self.costs.is_empty() && cost > HICCUP * self.worst() {
            self.doubtful = true;
            return;
        }
        self.doubtful = false;
        self.costs.push_back((now, cost));
        while self.costs.front().is_some_and(|&(then, _)| now.saturating_sub(then) > OBSERVATION) {
            self.costs.pop_front();
        }
        if too_slow {
            self.descend(now, cost);
        } else {
            self.climb(now);
        }
    }

    fn descend(&mut self, now: Duration, cost: f64) {
        let tried = self.climbed.filter(|_| now.saturating_sub(self.since) < TRIAL);
        if let Some(cost) = tried {
            let penance = match self.failed_attempt {
                Some(failed_attempt) if failed_attempt.level >= self.level => {
                    (2 * failed_attempt.penance).min(PENANCE[1])
                }
                _ => PENANCE[0],
            };
            self.failed_attempt =
                Some(FailedAttempt { level: self.level, cost, until: now + penance, penance });
        }
        // The previous level held its limit, so the estimate is right there: this level is more expensive
        // than estimated.
        let cost = tried.unwrap_or(cost);
        let fits = |&level: &usize| self.time(level, cost) <= SAFE * self.limit_ms();
        let level = (self.level + 1..LADDER.len()).find(fits).unwrap_or(LADDER.len() - 1);
        self.change(now, level, None);
    }

    fn climb(&mut self, now: Duration) {
        if self.level <= self.best() {
            return;
        }
        let level = self.level - 1;
        let worst = self.worst();
        let time = self.time(level, worst);
        let barred = self.failed_attempt.is_some_and(|failed_attempt| {
            level <= failed_attempt.level
                && now < failed_attempt.until
                && worst > CHEAPER * failed_attempt.cost
        });
        let wait = if time < 0.5 * self.limit_ms() { HURRY } else { OBSERVATION };
        let has_room = time <= ROOM * self.limit_ms() && now.saturating_sub(self.since) >= wait;
        if has_room && !barred {
            self.change(now, level, Some(worst));
        }
    }

    fn change(&mut self, now: Duration, level: usize, climbed: Option<f64>) {
        if level != self.level {
            self.level = level;
            self.since = now;
            self.climbed = climbed;
        }
    }
}

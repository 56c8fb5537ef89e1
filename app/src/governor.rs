//! The governor: holds a frame time by resolution, block size and tolerances, without visible pumping.
//!
//! It knows what frames cost from the frames themselves. Every report becomes an estimate of what a frame of the best level
//! would take; a level's frame takes its share of it. Down it goes at once and as far as it must; up one level at a time,
//! when even the worst of the last frames would have fitted there for a while. A level that was tried in vain is left
//! alone until frames get cheaper or a while has passed, longer every time: so that a load which does not change settles.

mod ladder;
#[cfg(test)]
mod tests;

use std::{collections::VecDeque, time::Duration};

use self::ladder::LADDER;
pub use self::ladder::Quality;

/// What a frame took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameReport {
    /// [`Quality::level`] of the frame. Frames at rest are not judged: nothing waits for them.
    pub level: Option<usize>,
    /// Its pixels.
    pub pixels: u64,
    /// Milliseconds of work, without waiting for the display: what the device says where it has a clock.
    pub ms: f64,
}

/// The level of the first frame, before anything is known: a quarter of the pixels.
const FIRST: usize = 5;

/// A level is gone up to if the worst of the last frames would have taken this share of the time there.
const ROOM: f64 = 0.93;

/// A level is gone down to if the frame that was too slow would have taken this share of the time there.
const SAFE: f64 = 0.88;

/// A frame that took so many times what was expected is taken for a hiccup of something else, if it is alone.
const HICCUP: f64 = 1.7;

/// There must have been room for so long.
const PATIENCE: Duration = Duration::from_millis(1000);

/// There must have been room for so long where frames could take twice as long, as after a heavy scene.
const HURRY: Duration = Duration::from_millis(250);

/// A level that was left within this time was tried in vain.
const TRIAL: Duration = Duration::from_secs(5);

/// It is not tried again for so long; twice as long after every vain trial, up to the second.
const PENANCE: [Duration; 2] = [Duration::from_secs(20), Duration::from_secs(160)];

/// Frames that became so much cheaper are another load: everything may be tried.
const CHEAPER: f64 = 0.85;

/// The camera must have rested for so long before a frame in full quality is made.
const REST: Duration = Duration::from_millis(200);

/// A level that was tried in vain.
#[derive(Clone, Copy, Debug)]
struct Vain {
    level: usize,
    /// What frames of the best level seemed to take when it was tried, in ms a pixel.
    cost: f64,
    until: Duration,
    penance: Duration,
}

/// Chooses the quality of every frame.
///
/// A change of level costs the caller new targets, as the size of the frame changes, and other kernels where the block
/// changes (between levels 4 and 5): keep those that are ready, and make others before the frame that needs them where that
/// takes long.
#[derive(Clone, Debug)]
pub struct Governor {
    budget_ms: f64,
    thermal: f64,
    /// No frame has a larger scale.
    largest: f32,
    level: usize,
    /// When the level was chosen.
    since: Duration,
    /// What frames of the best level took when this one was gone up to, in ms a pixel.
    climbed: Option<f64>,
    vain: Option<Vain>,
    /// Pixels of the view, as reports say.
    view: f64,
    /// When frames were made, and what those of the best level take, in ms a pixel.
    costs: VecDeque<(Duration, f64)>,
    /// The last frame may have been a hiccup.
    doubtful: bool,
    /// When the camera moved last.
    moved: Option<Duration>,
}

impl Governor {
    /// With the time for a frame in milliseconds.
    #[must_use]
    pub fn new(budget_ms: f64) -> Self {
        Self {
            budget_ms,
            thermal: 1.0,
            largest: 1.0,
            level: FIRST,
            since: Duration::ZERO,
            climbed: None,
            vain: None,
            view: 0.0,
            costs: VecDeque::new(),
            doubtful: false,
            moved: None,
        }
    }

    /// Another time for a frame, in milliseconds.
    pub fn set_budget(&mut self, budget_ms: f64) {
        if budget_ms != self.budget_ms {
            self.budget_ms = budget_ms;
            self.vain = None;
        }
    }

    /// How much of the time may be used, 1 while the device is cool: a hot one is spared before its clocks fall. Clamped to
    /// 0.1 to 1.
    pub fn set_thermal(&mut self, factor: f32) {
        if factor.is_finite() {
            self.thermal = f64::from(factor).clamp(0.1, 1.0);
        }
    }

    /// Memory is scarce: halves the largest scale, of moving and of resting frames, as often as it is called, down to the
    /// scale of the last level. Lasts until another governor is made.
    pub fn trim(&mut self) {
        self.largest = (0.5 * self.largest).max(LADDER[LADDER.len() - 1].scale);
        self.level = self.level.max(self.best());
    }

    /// The quality of the frame that is to be made `now`, on any clock that goes forward. `last` is what a frame took, if
    /// one was finished since the last call; `moving` says whether the camera or anything else changes. Before the first
    /// motion the camera rests: a first picture comes sooner as a moving one.
    pub fn next(&mut self, now: Duration, last: Option<FrameReport>, moving: bool) -> Quality {
        if moving {
            self.moved = Some(now);
        }
        if let Some(cost) = last.and_then(|report| self.cost(&report)) {
            self.learn(now, cost);
        }
        if self.moved.is_none_or(|moved| now.saturating_sub(moved) >= REST) {
            // Room is looked for from the next motion on.
            self.since = now;
            Quality { level: None, scale: self.largest, block: 2, relax: 1.0 }
        } else {
            let level = &LADDER[self.level];
            Quality { level: Some(self.level), scale: level.scale, block: level.block, relax: level.relax }
        }
    }

    /// No frame has a larger scale: 1 unless memory is scarce.
    #[must_use]
    pub fn largest(&self) -> f32 {
        self.largest
    }

    /// Milliseconds that a frame may take.
    #[must_use]
    pub fn limit_ms(&self) -> f64 {
        self.budget_ms * self.thermal
    }

    /// What a pixel of the best level would have taken, in ms.
    fn cost(&mut self, report: &FrameReport) -> Option<f64> {
        let level = LADDER.get(report.level?)?;
        let cost = report.ms / (report.pixels as f64 * level.work);
        if !(report.pixels > 0 && cost.is_finite() && cost > 0.0) {
            return None;
        }
        self.view = report.pixels as f64 / level.area();
        Some(cost)
    }

    /// What a frame of a level takes with that cost of a pixel, in ms.
    fn time(&self, level: usize, cost: f64) -> f64 {
        cost * self.view * LADDER[level].share()
    }

    /// The largest cost of the last frames.
    fn worst(&self) -> f64 {
        self.costs.iter().map(|&(_, cost)| cost).fold(0.0, f64::max)
    }

    /// The best level that memory has room for.
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
        while self.costs.front().is_some_and(|&(then, _)| now.saturating_sub(then) > PATIENCE) {
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
            let penance = match self.vain {
                Some(vain) if vain.level >= self.level => (2 * vain.penance).min(PENANCE[1]),
                _ => PENANCE[0],
            };
            self.vain = Some(Vain { level: self.level, cost, until: now + penance, penance });
        }
        // Frames fitted where it came from: it is this level that is dearer than it seemed.
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
        let barred = self
            .vain
            .is_some_and(|vain| level <= vain.level && now < vain.until && worst > CHEAPER * vain.cost);
        let patience = if time < 0.5 * self.limit_ms() { HURRY } else { PATIENCE };
        let has_room = time <= ROOM * self.limit_ms() && now.saturating_sub(self.since) >= patience;
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

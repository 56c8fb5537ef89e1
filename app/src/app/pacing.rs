//! Frame pacing: derives the quality of the next frame from measured frame times.

use std::time::Duration;

use crate::{Choices, FrameRate, FrameReport, Governor, Job, Quality};

/// The governor with its input, and statistics of the timed frames.
pub(crate) struct Pacing {
    governor: Governor,
    /// Quality of the frame requested last.
    quality: Quality,
    /// Report of the last timed frame, until it is passed to the governor.
    report: Option<FrameReport>,
    /// Fixed cost of frames in nanoseconds per pixel, which replaces measured times.
    fixed_cost: Option<f64>,
    tally: Tally,
    /// Number of timed frames.
    frames: u64,
}

/// Counts of timed frames of a moving camera since the frame rate was last chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub frames: u32,
    /// Frames that took longer than the governor's limit.
    pub late: u32,
}

impl Pacing {
    /// Starts without timed frames.
    pub fn new(choices: &Choices) -> Self {
        let rate = choices.governor.unwrap_or(FrameRate::Thirty);
        Self {
            governor: Governor::new(rate.budget_ms()),
            quality: Quality::FULL,
            report: None,
            fixed_cost: None,
            tally: Tally::default(),
            frames: 0,
        }
    }

    /// Chooses the quality of the next frame.
    pub fn advance(&mut self, choices: &Choices, now: Duration, moving: bool) -> Quality {
        self.quality = if let Some(rate) = choices.governed() {
            self.governor.set_budget(rate.budget_ms());
            self.governor.next(now, self.report.take(), moving)
        } else {
            // Frames of a method that reuses the last frame must not be cancelled while the camera moves.
            let keeps = moving && choices.settings.method.has_history();
            Quality { level: keeps.then_some(0), ..self.quality_at_rest(choices) }
        };
        self.quality
    }

    /// Quality of a frame at rest.
    pub fn quality_at_rest(&self, choices: &Choices) -> Quality {
        let scale = if choices.governed().is_some() { self.governor.largest() } else { choices.scale };
        Quality { scale, ..Quality::FULL }
    }

    /// Whether the frame requested last belongs to a moving camera.
    pub fn is_moving(&self) -> bool {
        self.quality.level.is_some()
    }

    /// Records a frame that took `ms` milliseconds on the device; returns the milliseconds it counts for.
    /// `None` if kernels were `compiled` during the frame, whose time is then meaningless.
    pub fn frame_arrived(&mut self, choices: &Choices, job: &Job, ms: f64, compiled: bool) -> Option<f64> {
        if compiled {
            return None;
        }
        let pixels = job.size.map(u64::from).iter().product();
        let ms = self.fixed_cost.map_or(ms, |cost| cost * pixels as f64 * 1e-6);
        self.frames += 1;
        let governed = choices.governed().is_some();
        self.report = governed.then_some(FrameReport { level: job.level, pixels, ms });
        if governed && !job.is_still() {
            self.tally.frames += 1;
            self.tally.late += u32::from(ms > self.governor.limit_ms());
        }
        Some(ms)
    }

    /// Replaces measured frame times by a fixed cost in nanoseconds per pixel.
    pub fn set_fixed_cost(&mut self, nanoseconds: f64) {
        self.fixed_cost = Some(nanoseconds);
    }

    /// Sets the factor on the time limit of frames: 1 while the device is cool.
    pub fn set_thermal(&mut self, factor: f32) {
        self.governor.set_thermal(factor);
    }

    /// Reduces memory use, see [`Governor::trim`].
    pub fn trim(&mut self) {
        self.governor.trim();
    }

    /// Restarts the tally after a frame rate was chosen.
    pub fn reset_tally(&mut self) {
        self.tally = Tally::default();
    }

    /// Counts of frames since the frame rate was last chosen.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Number of timed frames.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Describes what the governor does; empty while it is off.
    pub fn description(&self, choices: &Choices) -> String {
        let Quality { level, scale, block, relax } = self.quality;
        match (choices.governed(), level) {
            (None, _) => String::new(),
            (Some(_), None) if choices.refined().is_some() => {
                "at rest: as chosen, then refined where pixels differ".to_owned()
            }
            (Some(_), None) => "at rest: everything as chosen".to_owned(),
            (Some(_), Some(level)) => format!(
                "level {level}: {:.0} % a side, blocks from {block}, tolerances x {relax:.1}, at most {:.1} ms",
                100.0 * scale,
                self.governor.limit_ms()
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use glimpse::{Camera, Method, Settings, Show};

    use super::*;

    fn job(level: Option<usize>) -> Job {
        Job {
            camera: Camera::framing(Vec3::NEG_ONE, Vec3::ONE),
            size: [1000, 1000],
            settings: Settings::default(),
            show: Show::Final,
            split: false,
            level,
            is_refined: false,
        }
    }

    fn governed() -> Choices {
        Choices { governor: Some(FrameRate::Thirty), ..Choices::default() }
    }

    #[test]
    fn late_frames_of_a_moving_camera_are_tallied() {
        let choices = governed();
        let mut pacing = Pacing::new(&choices);
        assert_eq!(pacing.frame_arrived(&choices, &job(Some(0)), 10.0, false), Some(10.0));
        assert_eq!(pacing.frame_arrived(&choices, &job(Some(0)), 50.0, false), Some(50.0));
        assert_eq!(pacing.frame_arrived(&choices, &job(None), 50.0, false), Some(50.0), "at rest");
        assert_eq!(pacing.frame_arrived(&choices, &job(Some(0)), 900.0, true), None, "compiled");
        assert_eq!((pacing.tally(), pacing.frames()), (Tally { frames: 2, late: 1 }, 3));
        pacing.reset_tally();
        assert_eq!((pacing.tally(), pacing.frames()), (Tally::default(), 3));
    }

    #[test]
    fn a_fixed_cost_replaces_what_frames_took() {
        let choices = governed();
        let mut pacing = Pacing::new(&choices);
        pacing.set_fixed_cost(40.0);
        assert_eq!(pacing.frame_arrived(&choices, &job(Some(0)), 1.0, false), Some(40.0));
        assert_eq!(pacing.tally(), Tally { frames: 1, late: 1 });
    }

    #[test]
    fn frames_that_build_on_the_last_one_are_never_those_of_a_camera_at_rest() {
        let mut choices = Choices { governor: None, scale: 0.5, ..Choices::default() };
        let mut pacing = Pacing::new(&choices);
        let at_rest = Quality { scale: 0.5, ..Quality::FULL };
        assert_eq!(pacing.advance(&choices, Duration::ZERO, true), at_rest);
        choices.settings.method = Method::Frameless;
        assert_eq!(pacing.advance(&choices, Duration::ZERO, true), Quality { level: Some(0), ..at_rest });
        assert!(pacing.is_moving());
        assert_eq!(pacing.advance(&choices, Duration::ZERO, false), at_rest);
    }
}

//! Frame pacing: what frames took, and the quality that follows for the next.

use std::time::Duration;

use crate::{Choices, FrameRate, FrameReport, Governor, Job, Quality};

/// The governor, what it is told of frames, and the statistics of frames that were timed.
pub(crate) struct Pacing {
    governor: Governor,
    /// Quality of the frame that was requested last.
    quality: Quality,
    /// The last timed frame, until the governor is told.
    report: Option<FrameReport>,
    /// Nanoseconds a pixel that frames are taken to need, in place of their measured time.
    fixed_cost: Option<f64>,
    tally: Tally,
    /// Frames that were timed.
    frames: u64,
}

/// Timed frames of a moving camera since a frame rate was chosen last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    pub frames: u32,
    /// Those that took longer than the governor's limit.
    pub late: u32,
}

impl Pacing {
    /// Before the first frame.
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
            // Frames of a method that keeps some of the last one must not be given up while the camera moves.
            let keeps = moving && choices.settings.method.has_history();
            Quality { level: keeps.then_some(0), ..self.quality_at_rest(choices) }
        };
        self.quality
    }

    /// The quality of a frame at rest.
    pub fn quality_at_rest(&self, choices: &Choices) -> Quality {
        let scale = if choices.governed().is_some() { self.governor.largest() } else { choices.scale };
        Quality { scale, ..Quality::FULL }
    }

    /// The frame that was requested last is one of a moving camera.
    pub fn is_moving(&self) -> bool {
        self.quality.level.is_some()
    }

    /// Takes note of a frame that took `ms` milliseconds on the device; returns the milliseconds that it is taken to need.
    /// `None` for a frame that kernels were `compiled` for, whose time says nothing.
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

    /// Takes frames to need that many nanoseconds a pixel, whatever they take.
    pub fn set_fixed_cost(&mut self, nanoseconds: f64) {
        self.fixed_cost = Some(nanoseconds);
    }

    /// A factor on the time that a frame may take, 1 while the device is cool.
    pub fn set_thermal(&mut self, factor: f32) {
        self.governor.set_thermal(factor);
    }

    /// Memory is scarce: see [`Governor::trim`].
    pub fn trim(&mut self) {
        self.governor.trim();
    }

    /// A frame rate was chosen: the tally begins again.
    pub fn reset_tally(&mut self) {
        self.tally = Tally::default();
    }

    /// Frames since a frame rate was chosen last.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Frames that were timed so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// What the governor does, in words; empty while it is off.
    pub fn description(&self, choices: &Choices) -> String {
        let Quality { level, scale, block, relax } = self.quality;
        match (choices.governed(), level) {
            (None, _) => String::new(),
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

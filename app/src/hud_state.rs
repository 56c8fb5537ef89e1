//! The state of the app that the overlay displays.

use std::collections::VecDeque;

use glimpse::{Counts, Memory, Method, PassTime};

use crate::Folder;

/// Number of frame times that are kept.
pub const HISTORY: usize = 240;

/// Everything that the overlay displays.
#[derive(Clone, Debug, Default)]
pub struct HudState {
    /// Name of the scene.
    pub scene: String,
    /// Number of triangles and spheres.
    pub primitives: u64,
    /// Names of the scene's cameras.
    pub cameras: Vec<String>,
    /// Index of the camera chosen last.
    pub camera: usize,
    /// One line for each element that the importer left out or replaced.
    pub warnings: Vec<String>,
    /// One line for each feature of the file that is not shown.
    pub not_shown: Vec<String>,
    /// The same of what the pictures of a method alone do not show.
    pub not_shown_by: Vec<(Method, Vec<String>)>,
    /// Features that the scene needs.
    pub features: Vec<&'static str>,
    /// Features that are left out of its kernels.
    pub left_out: Vec<&'static str>,
    /// Name and driver of the graphics adapter.
    pub adapter: String,
    /// Times of the last frames in milliseconds, the newest last; at most [`HISTORY`].
    pub frame_ms: VecDeque<f32>,
    /// Times of the passes of the last frame.
    pub passes: Vec<PassTime>,
    /// Width and height of the last frame in pixels.
    pub size: [u32; 2],
    /// Width and height of the view in pixels.
    pub view: [u32; 2],
    /// Counters of the last frame at rest.
    pub counts: Option<Counts>,
    /// PSNR in dB of the last frame at rest against full tracing, while the view is split; infinite where they are
    /// equal.
    pub psnr_db: Option<f64>,
    /// Device memory in use, in bytes.
    pub memory: Memory,
    /// Legend of the quantity shown.
    pub legend: String,
    /// Description of what the governor does; empty while it is off.
    pub governor: String,
    /// Share of the frame at rest that is rendered, from 0 to 1, while it is not complete.
    pub rendered: Option<f32>,
    /// The long task in progress.
    pub busy: Option<Busy>,
    /// The folder in the list of files, while that is open.
    pub folder: Option<Folder>,
    /// The error message, until the user closes it.
    pub problem: Option<String>,
    /// A confirmation, shown for a few seconds.
    pub notice: Option<String>,
}

/// A long task and its progress.
#[derive(Clone, Debug, PartialEq)]
pub struct Busy {
    /// Description, such as `reading x.glb`.
    pub what: String,
    /// Seconds since the task began.
    pub seconds: f64,
    /// What the steps are, such as `step` or `kernel`.
    pub unit: &'static str,
    /// Current step, from 1, and number of steps.
    pub step: [u32; 2],
}

impl HudState {
    /// Appends a frame time in milliseconds, and drops the oldest beyond [`HISTORY`].
    pub fn push_frame(&mut self, ms: f32) {
        if self.frame_ms.len() == HISTORY {
            self.frame_ms.pop_front();
        }
        self.frame_ms.push_back(ms);
    }

    /// Mean frame time in milliseconds over the last half second, which is steady enough to read; `None` before the
    /// first frame.
    #[must_use]
    pub fn recent_ms(&self) -> Option<f32> {
        let (mut sum, mut frames) = (0.0, 0);
        for ms in self.frame_ms.iter().rev() {
            sum += ms;
            frames += 1;
            if sum >= 500.0 {
                break;
            }
        }
        (frames > 0).then(|| sum / frames as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_that_is_read_is_of_the_last_half_second() {
        let mut hud_state = HudState::default();
        assert_eq!(hud_state.recent_ms(), None);
        for ms in [1000.0, 200.0, 100.0, 300.0] {
            hud_state.push_frame(ms);
        }
        assert_eq!(hud_state.recent_ms(), Some(200.0));
        hud_state.push_frame(900.0);
        assert_eq!(hud_state.recent_ms(), Some(900.0));
    }

    #[test]
    fn the_oldest_times_are_forgotten() {
        let mut hud_state = HudState::default();
        for frame in 0..HISTORY + 7 {
            hud_state.push_frame(frame as f32);
        }
        assert_eq!((hud_state.frame_ms.len(), hud_state.frame_ms[0]), (HISTORY, 7.0));
    }
}

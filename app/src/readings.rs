//! What is known of the frames that were made: everything that the overlay shows.

use std::collections::VecDeque;

use glimpse::{Counts, Memory, PassTime};

/// The frame times that are kept.
pub const HISTORY: usize = 240;

/// What the overlay shows.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    /// The scene as it was named.
    pub scene: String,
    /// Its triangles and spheres.
    pub primitives: u64,
    /// Names of its cameras.
    pub cameras: Vec<String>,
    /// The one of them where the view was placed last.
    pub camera: usize,
    /// What the importer had to leave out or to replace.
    pub warnings: Vec<String>,
    /// Features that the scene needs, and those that were left out of its kernels.
    pub features: Vec<&'static str>,
    /// See above.
    pub left_out: Vec<&'static str>,
    /// Name and driver of the adapter.
    pub adapter: String,
    /// Times of the last frames in milliseconds, the newest last; at most [`HISTORY`].
    pub frame_ms: VecDeque<f32>,
    /// The passes of the last frame.
    pub passes: Vec<PassTime>,
    /// Pixels of the last frame.
    pub size: [u32; 2],
    /// Pixels of the view.
    pub view: [u32; 2],
    /// Counters of the last frame that was counted: a still one.
    pub counts: Option<Counts>,
    /// PSNR of the last still frame against full tracing, while the view is split; infinite where they are equal.
    pub psnr_db: Option<f64>,
    /// Bytes on the device.
    pub memory: Memory,
    /// The legend of what is shown.
    pub legend: String,
    /// What the governor does, for people; empty while it is off.
    pub governor: String,
    /// What is being waited for.
    pub busy: Option<Busy>,
    /// What went wrong, until it is closed.
    pub problem: Option<String>,
    /// What went well and is told for a moment.
    pub notice: Option<String>,
}

/// Long work and how far it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Busy {
    /// What is done, as `loading x.glb`.
    pub what: String,
    /// Seconds since it began.
    pub seconds: f64,
    /// The step of that many.
    pub step: [u32; 2],
}

impl Readings {
    /// Remembers the time of a frame.
    pub fn push_frame(&mut self, ms: f32) {
        if self.frame_ms.len() == HISTORY {
            self.frame_ms.pop_front();
        }
        self.frame_ms.push_back(ms);
    }

    /// Mean time of the frames of the last half second, which can be read while it changes; `None` before the first.
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
        let mut readings = Readings::default();
        assert_eq!(readings.recent_ms(), None);
        for ms in [1000.0, 200.0, 100.0, 300.0] {
            readings.push_frame(ms);
        }
        assert_eq!(readings.recent_ms(), Some(200.0));
        readings.push_frame(900.0);
        assert_eq!(readings.recent_ms(), Some(900.0));
    }

    #[test]
    fn the_oldest_times_are_forgotten() {
        let mut readings = Readings::default();
        for frame in 0..HISTORY + 7 {
            readings.push_frame(frame as f32);
        }
        assert_eq!((readings.frame_ms.len(), readings.frame_ms[0]), (HISTORY, 7.0));
    }
}

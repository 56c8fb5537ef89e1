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
}

//! Path tracing on CPU threads in addition to the GPU (Kim & Sung 2021, 3.1 and Algorithms 1, 2, 4, 5).
//!
//! A worker traces *planes*: one sample of every pixel of the image, of both eyes if there are two, by
//! [`reference::ReferenceFrame::path`](crate::reference::ReferenceFrame::path), the f64 implementation of the
//! shaders' estimator. It begins the next plane as soon as one is finished, independent of the GPU's frames. An
//! [`Accumulator`] collects finished planes between two frames of the GPU and passes their sum to
//! [`Renderer::accumulate`](crate::Renderer::accumulate).
//!
//! | Kim & Sung 2021 | here |
//! | --- | --- |
//! | Algorithm 2: a core fills its colour buffer | [`Worker::step`], a row at a time |
//! | Algorithm 1: core 1 merges what is finished, and no other core writes there | [`Accumulator::collect`] |
//! | Algorithm 4, lines 2 and 3: merged colours are delivered | the upload in [`Renderer::accumulate`](crate::Renderer::accumulate) |
//! | Algorithm 5, lines 4 to 9: merged into the GPU's buffer | `passes/path/accumulate.wgsl` |
//! | Algorithm 5, lines 10 to 14: noise is removed from the sum | `passes/denoise/median.wgsl`, or `atrous`, once more |
//!
//! No thread waits for another. In the paper the owner polls whether a core has filled its buffer while the core
//! fills another one: two buffers per core. Here the channel to the accumulator holds one plane per worker, and
//! planes finished while it is full are added to the next delivery. The accumulator may therefore collect as
//! rarely as it likes, and a slow worker does not delay the others.
//!
//! Samples have indices, which determine their random numbers: the GPU counts from 0, all workers together from
//! [`FIRST_SAMPLE`]. All belong to one sequence, and none is drawn twice.

mod accumulator;
mod pass;
#[cfg(test)]
mod tests;
mod worker;

use std::sync::{
    Arc,
    atomic::{AtomicU32, AtomicU64, Ordering},
};

pub use accumulator::Accumulator;
pub(crate) use pass::AccumulatePass;
pub use worker::Worker;

use crate::{Camera, Denoise, Paths, Settings};

/// Index of the workers' first sample. The GPU does not get there: at 100 frames per second it would take 248
/// days.
pub const FIRST_SAMPLE: u32 = 1 << 31;

/// A camera, an image size and the settings that path samples depend on. Samples of different views are never
/// added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    camera: Camera,
    size: [u32; 2],
    /// The settings that paths depend on; all others have their defaults.
    settings: Settings,
}

impl View {
    /// A view of `size` pixels. Settings that paths do not depend on do not distinguish views.
    #[must_use]
    pub fn new(camera: &Camera, size: [u32; 2], settings: &Settings) -> Self {
        let Settings { method, depth, mip, seed, .. } = *settings;
        let paths = Paths { denoise: Denoise::Off, ..settings.paths };
        let settings = Settings { method, depth, mip, seed, paths, ..Settings::default() };
        Self { camera: *camera, size, settings }
    }
}

/// The sums of one or more samples of every pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleImage {
    /// Number of samples per pixel.
    pub samples: u32,
    /// Sums of linear RGB radiance, row by row from the top left.
    pub rgb: Vec<f32>,
}

impl SampleImage {
    fn add(&mut self, other: &Self) {
        self.samples += other.samples;
        self.rgb.iter_mut().zip(&other.rgb).for_each(|(sum, more)| *sum += more);
    }
}

/// Numbers of samples by state, over all views; begun samples in neither other state are being traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleCounts {
    /// Samples begun.
    pub begun: u64,
    /// Samples collected for the renderer.
    pub merged: u64,
    /// Samples discarded because the view changed or the work ended.
    pub given_up: u64,
}

/// The view that workers trace until they receive another.
struct Order {
    view: View,
    /// Index of the next sample in the sequence.
    next: AtomicU32,
    tally: Arc<Tally>,
}

/// Shared counters of samples by state.
#[derive(Default)]
struct Tally {
    begun: AtomicU64,
    given_up: AtomicU64,
}

impl Order {
    fn new(view: &View, tally: &Arc<Tally>) -> Arc<Self> {
        Arc::new(Self { view: *view, next: AtomicU32::new(FIRST_SAMPLE), tally: tally.clone() })
    }

    fn begin(&self) -> u32 {
        self.tally.begun.fetch_add(1, Ordering::Relaxed);
        self.next.fetch_add(1, Ordering::Relaxed)
    }
}

impl Tally {
    fn give_up(&self, samples: u32) {
        self.given_up.fetch_add(u64::from(samples), Ordering::Relaxed);
    }
}

/// A delivered plane with the order that it belongs to.
struct Delivery {
    order: Arc<Order>,
    image: SampleImage,
}

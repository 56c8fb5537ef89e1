//! Samples of paths from the cores of a CPU beside those of a GPU (Kim & Sung 2021, 3.1 and Algorithms 1, 2, 4, 5).
//!
//! A core traces *planes*: one sample of every pixel of the picture, both eyes' where there are two, by
//! [`reference::ReferenceFrame::path`](crate::reference::ReferenceFrame::path), which is the estimator of the shaders in f64. It begins the
//! next one as soon as it has one, at its own pace. One [`Accumulator`] takes what is finished between two frames of the GPU and
//! hands the sum to [`Renderer::accumulate`](crate::Renderer::accumulate).
//!
//! | Kim & Sung 2021 | here |
//! | --- | --- |
//! | Algorithm 2: a core fills its colour buffer | [`Worker::step`], a row at a time |
//! | Algorithm 1: core 1 merges what is finished, and no other core writes there | [`Accumulator::collect`] |
//! | Algorithm 4, lines 2 and 3: merged colours are delivered | the upload in [`Renderer::accumulate`](crate::Renderer::accumulate) |
//! | Algorithm 5, lines 4 to 9: merged into the GPU's buffer | `passes/path/accumulate.wgsl` |
//! | Algorithm 5, lines 10 to 14: noise is removed from the sum | `passes/denoise/median.wgsl`, or `atrous`, once more |
//!
//! Nobody waits. The paper's owner looks whether a core has filled its buffer, and cores fill others meanwhile: two buffers
//! a core. Here a core has a slot for a plane that is on its way, and what it finishes while the slot is taken is added to
//! what it hands over next. So the owner may come as seldom as it likes, and a slow core delays no other.
//!
//! Samples are numbered, and a number stands for the random numbers of the sample: the GPU counts from 0, the cores
//! together from [`FIRST_SAMPLE`]. All are of one sequence, and none is drawn twice.

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

/// The number of the first sample of the cores. No GPU comes so far: at 100 frames a second it takes 248 days.
pub const FIRST_SAMPLE: u32 = 1 << 31;

/// A camera, a picture size and the settings that path samples depend on. Samples of different views are never added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    camera: Camera,
    size: [u32; 2],
    /// Default settings except for those that paths depend on.
    settings: Settings,
}

impl View {
    /// From where, in pixels, and how: settings that paths do not heed make no other view.
    #[must_use]
    pub fn new(camera: &Camera, size: [u32; 2], settings: &Settings) -> Self {
        let Settings { method, depth, mip, seed, .. } = *settings;
        let paths = Paths { denoise: Denoise::Off, ..settings.paths };
        let settings = Settings { method, depth, mip, seed, paths, ..Settings::default() };
        Self { camera: *camera, size, settings }
    }
}

/// The sum of several samples of each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct SampleImage {
    /// Number of samples of each pixel.
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

/// Numbers of samples by their state, over all views. The rest of those begun are still being traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SampleCounts {
    /// Samples that were begun.
    pub begun: u64,
    /// Samples that were handed to the renderer or are ready to be.
    pub merged: u64,
    /// Samples of a view that was left, or that were unfinished when the work ended.
    pub given_up: u64,
}

/// The work on one view: an order is followed until there is another.
struct Order {
    view: View,
    /// The number of the next sample of the sequence.
    next: AtomicU32,
    tally: Arc<Tally>,
}

/// Counts samples by what became of them.
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

/// A plane on its way, with what it was ordered for.
struct Delivery {
    order: Arc<Order>,
    image: SampleImage,
}

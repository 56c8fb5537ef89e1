//! Sequences of frames that reuse earlier ones: which pixels a frame traces, and which of two history buffers it
//! reads.
//!
//! Every pixel of a 16 x 16 tile has a rank of its own (`refresh.wgsl`). Each frame traces the next few ranks in
//! cyclic order, so that no pixel is older than `1 / share` frames.

use crate::{Camera, Method, Settings};

/// Number of ranks in a tile, and the tile's side in pixels.
pub const RANKS: u32 = RANK_TILE * RANK_TILE;
pub const RANK_TILE: u32 = 16;

/// The position of one frame in a sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Step {
    /// First rank that the frame traces.
    pub first: u32,
    /// Number of ranks that it traces, in cyclic order; all [`RANKS`] in the first frame of a sequence.
    pub count: u32,
    /// Whether the camera is the same as in the frame before.
    pub still: bool,
    /// Number of earlier frames with this camera.
    pub sample: u32,
    /// Samples per pixel added from elsewhere for this camera ([`Sequence::accumulate`]).
    pub merged: u32,
    /// Index of the history buffer that the frame writes; it reads the other one.
    pub side: usize,
    /// Whether the frame first clears the samples that a given up frame has left.
    pub clears: bool,
}

/// The state of a sequence between frames.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Number of ranks that each frame but the first traces.
    count: u32,
    /// Samples per pixel at which path tracing is complete; 0 for methods that do not accumulate samples.
    samples: u32,
    /// The last finished frame; `None` before the first one.
    last: Option<Last>,
    /// Whether an accumulating frame was given up and none has been finished since.
    given_up: bool,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    step: Step,
    camera: Camera,
    /// Number of ranks traced since the camera came to rest.
    refreshed: u32,
}

impl Sequence {
    /// A sequence with these settings, before its first frame.
    pub fn new(settings: &Settings) -> Self {
        let (count, samples) = match settings.method {
            Method::Path | Method::Vr => (RANKS, settings.paths.samples),
            method if method.has_history() => (refresh_ranks(settings.refresh_fraction), 0),
            _ => (RANKS, 0),
        };
        Self { count, samples, last: None, given_up: false }
    }

    /// The step of the frame that follows the last one.
    pub fn next(&self, camera: &Camera) -> Step {
        let Some(last) = &self.last else {
            return Step { count: RANKS, clears: self.given_up, ..Step::default() };
        };
        let still = last.camera == *camera;
        Step {
            first: (last.step.first + last.step.count) % RANKS,
            count: self.count,
            still,
            sample: if still { last.step.sample.saturating_add(1) } else { 0 },
            merged: if still { last.step.merged } else { 0 },
            side: 1 - last.step.side,
            clears: false,
        }
    }

    /// The last frame's step again, or the first frame's.
    pub fn again(&self, camera: &Camera) -> Step {
        self.last.map_or_else(|| self.next(camera), |last| last.step)
    }

    /// Records that a frame was finished.
    pub fn done(&mut self, step: Step, camera: &Camera) {
        let before = self.last.filter(|_| step.still).map_or(0, |last| last.refreshed);
        self.last = Some(Last { step, camera: *camera, refreshed: RANKS.min(before + step.count) });
        self.given_up = false;
    }

    /// Records that a frame was begun and will not be finished. When samples accumulate, some pixels then have
    /// one more than others, so the sequence starts anew.
    pub fn give_up(&mut self) {
        if self.samples > 0 {
            self.last = None;
            self.given_up = true;
        }
    }

    /// Records that `samples` samples per pixel were added to the last frame.
    pub fn accumulate(&mut self, samples: u32) {
        if let Some(last) = &mut self.last {
            last.step.merged = last.step.merged.saturating_add(samples);
        }
    }

    /// The last frame's camera.
    pub fn camera(&self) -> Option<Camera> {
        self.last.map(|last| last.camera)
    }

    /// Samples per pixel added from elsewhere since the camera came to rest.
    pub fn merged(&self) -> u32 {
        self.last.map_or(0, |last| last.step.merged)
    }

    /// Starts a new sequence.
    pub fn reset(&mut self) {
        self.last = None;
    }

    /// Number of frames accumulated in the last one; 1 for methods that do not accumulate samples.
    pub fn frames(&self) -> u32 {
        self.last.filter(|_| self.samples > 0).map_or(1, |last| last.step.sample + 1)
    }

    /// Whether all pixels were traced since the camera came to rest and have all their samples.
    pub fn is_settled(&self) -> bool {
        self.last.is_some_and(|last| {
            let samples = last.step.sample.saturating_add(1).saturating_add(last.step.merged);
            last.refreshed == RANKS && samples >= self.samples
        })
    }
}

/// The smallest number of ranks that is at least `share` of a tile, but at least one.
fn refresh_ranks(share: f32) -> u32 {
    ((share * RANKS as f32).ceil() as u32).clamp(1, RANKS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Method;

    fn camera(x: f32) -> Camera {
        Camera {
            origin: glam::Vec3::X * x,
            right: glam::Vec3::X,
            up: glam::Vec3::Y,
            forward: glam::Vec3::NEG_Z,
            orthographic: false,
        }
    }

    fn sequence(share: f32) -> Sequence {
        Sequence::new(&Settings { method: Method::Frameless, refresh_fraction: share, ..Settings::default() })
    }

    fn step(sequence: &mut Sequence, x: f32) -> Vec<u32> {
        let step = sequence.next(&camera(x));
        sequence.done(step, &camera(x));
        (step.first..step.first + step.count).map(|rank| rank % RANKS).collect()
    }

    #[test]
    fn every_rank_comes_within_the_promised_frames_and_none_twice_before_all_others() {
        for share in [0.001, 1.0 / 256.0, 0.05, 0.1, 0.13, 0.3, 0.5, 0.77, 1.0] {
            let mut sequence = sequence(share);
            assert_eq!(step(&mut sequence, 0.0).len(), RANKS as usize, "the first frame");
            let frames: Vec<_> = (1..600).map(|x| step(&mut sequence, x as f32)).collect();
            let promised = (1.0 / share).ceil() as usize;
            for window in frames.windows(promised) {
                let mut seen = [false; RANKS as usize];
                window.iter().flatten().for_each(|rank| seen[*rank as usize] = true);
                assert!(seen.iter().all(|seen| *seen), "{share}");
            }
            let tile_order: Vec<_> = frames.into_iter().flatten().collect();
            for around in tile_order.windows(RANKS as usize) {
                assert!(!around[1..].contains(&around[0]), "{share}");
            }
        }
    }

    #[test]
    fn a_frame_costs_no_more_than_its_share_and_a_rank() {
        for share in [0.01, 0.1, 0.25, 0.9] {
            let ranks = refresh_ranks(share) as f32;
            assert!((share * 256.0..share * 256.0 + 1.0).contains(&ranks), "{share}: {ranks}");
        }
    }

    #[test]
    fn a_sequence_settles_when_the_camera_has_rested_for_the_promised_frames() {
        let mut sequence = sequence(0.1);
        assert!(!sequence.is_settled());
        step(&mut sequence, 0.0);
        assert!(sequence.is_settled());
        for frame in 1..=10 {
            step(&mut sequence, 1.0);
            assert_eq!(sequence.is_settled(), frame == 10, "{frame}");
        }
        step(&mut sequence, 2.0);
        assert!(!sequence.is_settled());
        sequence.reset();
        assert_eq!(step(&mut sequence, 2.0).len(), RANKS as usize);
    }

    #[test]
    fn the_last_frame_can_be_made_again() {
        let mut sequence = sequence(0.1);
        assert_eq!(sequence.again(&camera(0.0)), sequence.next(&camera(0.0)));
        step(&mut sequence, 0.0);
        let next = sequence.next(&camera(1.0));
        sequence.done(next, &camera(1.0));
        assert_eq!(sequence.again(&camera(1.0)), next);
    }
}

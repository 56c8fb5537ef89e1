//! Frames that follow on each other: which pixels a frame traces anew, and which of two histories it goes on from.
//!
//! Every pixel of a tile of 16 x 16 has a rank of its own (`refresh.wgsl`). A frame renews so many ranks, the next one goes
//! on with those that follow, around and around: no pixel is ever older than `1 / share` frames.

use crate::{Camera, Method, Settings};

/// Ranks of a tile, and its side.
pub const RANKS: u32 = RANK_TILE * RANK_TILE;
pub const RANK_TILE: u32 = 16;

/// One frame of a sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Step {
    /// The first rank that is traced anew.
    pub first: u32,
    /// How many are, around to the first ones; [`RANKS`] of them in a frame that follows on nothing.
    pub count: u32,
    /// The camera is that of the frame before.
    pub still: bool,
    /// The frames since it came to where it is, before this one.
    pub sample: u32,
    /// Samples of each pixel that were added beside those of the frames.
    pub merged: u32,
    /// Which of the two histories is written.
    pub side: usize,
    /// What is left of the samples of a frame that was given up is cleared first.
    pub clears: bool,
}

/// Where a sequence stands.
#[derive(Clone, Debug)]
pub struct Sequence {
    /// Ranks that a frame renews.
    count: u32,
    /// Samples of paths that a pixel is to have; 0 where frames do not add them up.
    samples: u32,
    /// The last frame.
    last: Option<Last>,
    /// A frame that adds samples up was given up, and none was finished since.
    given_up: bool,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    step: Step,
    camera: Camera,
    /// Ranks that were traced anew since the camera came to where it is.
    refreshed: u32,
}

impl Sequence {
    /// Of frames with these settings; the first is yet to come.
    pub fn new(settings: &Settings) -> Self {
        let (count, samples) = match settings.method {
            Method::Path | Method::Vr => (RANKS, settings.paths.samples),
            method if method.has_history() => (refresh_ranks(settings.refresh_fraction), 0),
            _ => (RANKS, 0),
        };
        Self { count, samples, last: None, given_up: false }
    }

    /// The frame that follows.
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

    /// The last frame once more, or the first.
    pub fn again(&self, camera: &Camera) -> Step {
        self.last.map_or_else(|| self.next(camera), |last| last.step)
    }

    /// The frame was finished.
    pub fn done(&mut self, step: Step, camera: &Camera) {
        let before = self.last.filter(|_| step.still).map_or(0, |last| last.refreshed);
        self.last = Some(Last { step, camera: *camera, refreshed: RANKS.min(before + step.count) });
        self.given_up = false;
    }

    /// The frame was begun and will not be finished. Where samples are added up, some pixels have one that others lack: the
    /// next frame follows on nothing.
    pub fn give_up(&mut self) {
        if self.samples > 0 {
            self.last = None;
            self.given_up = true;
        }
    }

    /// So many samples were added to what the last frame shows.
    pub fn accumulate(&mut self, samples: u32) {
        if let Some(last) = &mut self.last {
            last.step.merged = last.step.merged.saturating_add(samples);
        }
    }

    /// The last frame's camera.
    pub fn camera(&self) -> Option<Camera> {
        self.last.map(|last| last.camera)
    }

    /// How many samples were added since the camera came to where it is.
    pub fn merged(&self) -> u32 {
        self.last.map_or(0, |last| last.step.merged)
    }

    /// The next frame follows on nothing.
    pub fn reset(&mut self) {
        self.last = None;
    }

    /// How many frames the last one is made of.
    pub fn frames(&self) -> u32 {
        self.last.filter(|_| self.samples > 0).map_or(1, |last| last.step.sample + 1)
    }

    /// Whether the last frame shows in every pixel what a ray through its centre sees from that frame's camera, or
    /// all samples of paths that it is to show.
    pub fn is_settled(&self) -> bool {
        self.last.is_some_and(|last| {
            let samples = last.step.sample.saturating_add(1).saturating_add(last.step.merged);
            last.refreshed == RANKS && samples >= self.samples
        })
    }
}

/// At least that share of a tile's ranks, and one.
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

//! What is ordered of the worker, and where the orders lie.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use glimpse::{Camera, GpuScene};

use crate::{Job, SceneFacts};

/// What lies on the worker's desk. A newer order of a kind replaces the older.
#[derive(Default)]
pub(crate) struct Desk {
    pub scene: Option<Loaded>,
    pub job: Option<(u64, Job)>,
    pub capture: Option<Job>,
    pub pick: Option<(Camera, [f32; 2])>,
    /// The number of the last scene that was asked for: loads that are late are thrown away.
    pub asked: u64,
    pub stop: bool,
    /// Nobody sees the view: frames of a resting one are given up.
    pub hidden: bool,
}

pub(crate) struct Loaded {
    pub scene: GpuScene,
    pub facts: SceneFacts,
}

/// The desk and the bell on it.
#[derive(Default)]
pub(crate) struct Office {
    desk: Mutex<Desk>,
    pub bell: Condvar,
}

/// What is to be done next.
pub(crate) enum Order {
    Frame(u64, Job),
    Capture(Job),
    Pick(Camera, [f32; 2]),
    /// Another scene, or the end.
    Leave,
}

impl Office {
    /// The desk, for one change or look.
    pub fn desk(&self) -> MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a scene; `None` at the end.
    pub fn scene(&self) -> Option<Loaded> {
        let mut desk = self.desk();
        loop {
            if desk.stop {
                return None;
            }
            if let Some(loaded) = desk.scene.take() {
                // Jobs were of the scene before.
                desk.job = None;
                return Some(loaded);
            }
            desk = self.bell.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits for an order.
    pub fn next(&self) -> Order {
        let mut desk = self.desk();
        loop {
            if desk.stop || desk.scene.is_some() {
                return Order::Leave;
            }
            if let Some((camera, at)) = desk.pick.take() {
                return Order::Pick(camera, at);
            }
            if let Some(job) = desk.capture.take() {
                return Order::Capture(job);
            }
            if let Some((number, job)) = desk.job.take() {
                return Order::Frame(number, job);
            }
            desk = self.bell.wait(desk).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether a frame of a still view is to be given up for something more urgent, or because nobody sees it.
    pub fn is_urgent(&self) -> bool {
        let desk = self.desk();
        desk.hidden || desk.stop || desk.scene.is_some() || desk.job.is_some() || desk.pick.is_some()
    }
}

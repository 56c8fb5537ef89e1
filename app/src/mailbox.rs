//! The requests to the worker thread and the mailbox that holds them.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use glimpse::{Camera, Result};

use crate::{Job, loading::Loaded};

/// The slots of the mailbox, one for each kind of request. A newer request replaces an older one of its kind.
#[derive(Default)]
pub(crate) struct Slots {
    pub scene: Option<Loaded>,
    pub job: Option<(u64, Job)>,
    pub capture: Option<Job>,
    pub pick: Option<(Camera, [f32; 2])>,
    /// Whether kernels that the worker waits for were compiled, or could not be.
    pub compiled: Option<Result<()>>,
    /// Number of the last requested scene: a loader that finishes with an older number discards its result.
    pub asked: u64,
    pub stop: bool,
    /// Whether the view is hidden, so that frames at rest are cancelled.
    pub hidden: bool,
}

/// The mailbox: slots under a lock, and the condition variable that wakes the worker.
#[derive(Default)]
pub(crate) struct Mailbox {
    slots: Mutex<Slots>,
    pub posted: Condvar,
}

/// The next task of the worker.
pub(crate) enum Order {
    Frame(u64, Job),
    Capture(Job),
    Pick(Camera, [f32; 2]),
    /// Kernels were compiled, or could not be.
    Compiled(Result<()>),
    /// Leave the scene: another one is waiting, or the thread must end.
    Leave,
}

impl Mailbox {
    /// Locks the slots.
    pub fn slots(&self) -> MutexGuard<'_, Slots> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits for a loaded scene; `None` when the thread must end.
    pub fn scene(&self) -> Option<Loaded> {
        let mut slots = self.slots();
        loop {
            if slots.stop {
                return None;
            }
            if let Some(loaded) = slots.scene.take() {
                // A waiting job, and kernels, belong to the previous scene.
                (slots.job, slots.compiled) = (None, None);
                return Some(loaded);
            }
            slots = self.posted.wait(slots).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Waits for a request. Picking takes precedence over captures, these over frames, and
    /// these over compiled kernels.
    pub fn next(&self) -> Order {
        let mut slots = self.slots();
        loop {
            if slots.stop || slots.scene.is_some() {
                return Order::Leave;
            }
            if let Some((camera, at)) = slots.pick.take() {
                return Order::Pick(camera, at);
            }
            if let Some(job) = slots.capture.take() {
                return Order::Capture(job);
            }
            if let Some((number, job)) = slots.job.take() {
                return Order::Frame(number, job);
            }
            if let Some(compiled) = slots.compiled.take() {
                return Order::Compiled(compiled);
            }
            slots = self.posted.wait(slots).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Tells the worker that kernels were compiled, or could not be.
    pub fn kernels_compiled(&self, compiled: Result<()>) {
        self.slots().compiled = Some(compiled);
        self.posted.notify_one();
    }

    /// Whether a frame at rest is to be cancelled because another request waits or the view is hidden.
    pub fn is_urgent(&self) -> bool {
        let slots = self.slots();
        slots.hidden || slots.stop || slots.scene.is_some() || slots.job.is_some() || slots.pick.is_some()
    }
}

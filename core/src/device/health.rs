//! Device loss and errors that wgpu reports outside of the call that caused them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::Gpu;
use crate::{Error, Result};

/// Reports of the device so far.
#[derive(Default)]
pub(super) struct Health {
    /// The reason of the loss, once the device is lost.
    pub lost: OnceLock<String>,
    /// The first error that no scope caught.
    uncaught: Mutex<Option<wgpu::Error>>,
}

impl Health {
    /// Registers callbacks for loss and uncaptured errors of a device that this crate made.
    pub fn watch(self: &Arc<Self>, device: &wgpu::Device) {
        let sink = Arc::clone(self);
        device.on_uncaptured_error(Arc::new(move |error| {
            sink.uncaught.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }));
        device.set_device_lost_callback(self.on_lost());
    }

    /// What is called when the device is lost.
    pub fn on_lost(self: &Arc<Self>) -> impl Fn(wgpu::DeviceLostReason, String) + Send + Sync + use<> {
        let sink = Arc::clone(self);
        move |reason, message| {
            sink.lose(if message.is_empty() { format!("{reason:?}") } else { message });
        }
    }

    /// Takes the device for lost; the first reason stays.
    pub fn lose(&self, reason: String) {
        // It was lost before: the first reason is the cause.
        let _ = self.lost.set(reason);
    }
}

impl Gpu {
    /// Fails where the device has failed. Calls on a lost device return as if they had worked, so this goes after them.
    ///
    /// # Errors
    /// [`Error::Lost`] before all others: a lost device gives rise to errors of every other kind.
    pub(super) fn check_health(&self) -> Result<()> {
        if let Some(reason) = self.health.lost.get() {
            return Err(Error::Lost { adapter: self.facts.info.name.clone(), reason: reason.clone() });
        }
        match self.health.uncaught.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(error) => Err(self.refused("a frame's commands", None, &error)),
        }
    }

    /// The error for a failed call, unless the device is lost, which explains every failure.
    pub(super) fn failed(&self, message: impl std::fmt::Display) -> Error {
        self.check_health().err().unwrap_or_else(|| Error::Device(message.to_string()))
    }

    /// The error for what the device refuses to make.
    pub(super) fn refused(&self, what: &str, bytes: Option<u64>, error: &wgpu::Error) -> Error {
        match error {
            wgpu::Error::OutOfMemory { .. } => {
                Error::OutOfMemory { what: what.to_owned(), bytes, adapter: self.facts.info.name.clone() }
            }
            _ => Error::Device(error.to_string()),
        }
    }
}

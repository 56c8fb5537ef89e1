//! Detects device loss and errors that wgpu reports outside the call that caused them.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::Gpu;
use crate::{Error, Result};

/// The errors that the device has reported so far.
#[derive(Default)]
pub(super) struct Health {
    /// Reason for the loss of the device; set once it is lost.
    pub lost: OnceLock<String>,
    /// The first error that no error scope caught.
    uncaught: Mutex<Option<wgpu::Error>>,
}

impl Health {
    /// Registers callbacks for loss and uncaptured errors on a device that this crate has created.
    pub fn watch(self: &Arc<Self>, device: &wgpu::Device) {
        let sink = Arc::clone(self);
        device.on_uncaptured_error(Arc::new(move |error| {
            sink.uncaught.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }));
        device.set_device_lost_callback(self.on_lost());
    }

    /// The callback for the loss of the device.
    pub fn on_lost(self: &Arc<Self>) -> impl Fn(wgpu::DeviceLostReason, String) + Send + Sync + use<> {
        let sink = Arc::clone(self);
        move |reason, message| {
            sink.lose(if message.is_empty() { format!("{reason:?}") } else { message });
        }
    }

    /// Marks the device as lost; only the first reason is kept.
    pub fn lose(&self, reason: String) {
        // An earlier reason is the cause and stays.
        let _ = self.lost.set(reason);
    }
}

impl Gpu {
    /// Returns the failure of the device, if it has failed. Calls on a lost device appear to succeed, so check
    /// after them.
    ///
    /// # Errors
    /// [`Error::Lost`] takes precedence: a lost device causes errors of every other kind.
    pub(super) fn check_health(&self) -> Result<()> {
        if let Some(reason) = self.health.lost.get() {
            return Err(Error::Lost { adapter: self.facts.info.name.clone(), reason: reason.clone() });
        }
        match self.health.uncaught.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(error) => Err(self.refused("a frame's commands", None, &error)),
        }
    }

    /// The error of a failed call: the loss of the device if it is lost, else [`Error::Device`] with the message.
    pub(super) fn failed(&self, message: impl std::fmt::Display) -> Error {
        self.check_health().err().unwrap_or_else(|| Error::Device(message.to_string()))
    }

    /// The error for something that the device refused to create.
    pub(super) fn refused(&self, what: &str, bytes: Option<u64>, error: &wgpu::Error) -> Error {
        match error {
            wgpu::Error::OutOfMemory { .. } => {
                Error::OutOfMemory { what: what.to_owned(), bytes, adapter: self.facts.info.name.clone() }
            }
            _ => Error::Device(error.to_string()),
        }
    }
}

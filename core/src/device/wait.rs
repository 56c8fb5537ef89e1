//! Submits command buffers, waits for them and reads results back.

use std::{
    iter, mem,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::{MutexGuard, PoisonError, mpsc},
};

use super::{Gpu, memory::padded_row};
use crate::{Error, Result};

/// Attempts to configure a surface; wgpu abandons one if another thread submits at the same time.
const CONFIGURATIONS: usize = 100;

impl Gpu {
    /// Configures a surface, synchronised with the submissions of other threads.
    ///
    /// # Errors
    /// The device failed, or the surface does not support the configuration.
    pub fn configure(&self, surface: &wgpu::Surface<'_>, config: &wgpu::SurfaceConfiguration) -> Result<()> {
        let _submit_lock = self.submit_lock();
        let mut done = Ok(());
        for _ in 0..CONFIGURATIONS {
            done = self.checked("surface", None, |device| surface.configure(device, config));
            if !matches!(done, Err(Error::Device(_))) {
                break;
            }
        }
        done
    }

    /// Submits one command buffer and waits until the device has executed it.
    pub(crate) fn submit_and_wait(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        self.submit_all_and_wait(iter::once(encoder).map(wgpu::CommandEncoder::finish))
    }

    /// Submits each command buffer by itself, in order, and waits until the device has executed all. The device
    /// executes those submitted while the next one is recorded.
    pub(crate) fn submit_all_and_wait(
        &self,
        commands: impl IntoIterator<Item = wgpu::CommandBuffer>,
    ) -> Result<()> {
        self.submitted(commands, &self.submit_lock())
    }

    /// Like [`Gpu::submit_all_and_wait`], but keeps at most two submissions in flight and stops submitting once
    /// `cancelled` returns true. Returns whether all were submitted.
    pub(crate) fn submit_until(
        &self,
        mut commands: impl ExactSizeIterator<Item = wgpu::CommandBuffer>,
        cancelled: &dyn Fn(f32) -> bool,
    ) -> Result<bool> {
        let _submit_lock = self.submit_lock();
        let mut last = None;
        let all = commands.len() as f32;
        while commands.len() > 0 {
            if cancelled(1.0 - commands.len() as f32 / all) {
                self.wait_for(last)?;
                return Ok(false);
            }
            let next = self.submit_next(&mut commands)?;
            if let Some(before) = mem::replace(&mut last, next) {
                self.wait_for(Some(before))?;
            }
        }
        self.wait_for(last)?;
        Ok(true)
    }

    /// Copies a buffer with usage `COPY_SRC` to main memory.
    pub(crate) fn read_buffer(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>> {
        self.read(buffer.size(), |encoder, staging| {
            encoder.copy_buffer_to_buffer(buffer, 0, staging, 0, buffer.size());
        })
    }

    /// Copies a texture with usage `COPY_SRC` to main memory, with tightly packed rows.
    ///
    /// # Errors
    /// The device failed or has no memory for the copy.
    pub fn read_texture(&self, texture: &wgpu::Texture, bytes_per_texel: u32) -> Result<Vec<u8>> {
        let (width, height) = (texture.width(), texture.height());
        let row = (width * bytes_per_texel) as usize;
        let padded = padded_row(width, bytes_per_texel) as usize;
        let mut bytes = self.read((padded * height as usize) as u64, |encoder, staging| {
            encoder.copy_texture_to_buffer(
                texture.as_image_copy(),
                wgpu::TexelCopyBufferInfo {
                    buffer: staging,
                    layout: wgpu::TexelCopyBufferLayout {
                        offset: 0,
                        bytes_per_row: Some(padded as u32),
                        rows_per_image: None,
                    },
                },
                texture.size(),
            );
        })?;
        if padded > row {
            for line in 0..height as usize {
                bytes.copy_within(line * padded..line * padded + row, line * row);
            }
            bytes.truncate(row * height as usize);
        }
        Ok(bytes)
    }

    fn read(
        &self,
        bytes: u64,
        copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    ) -> Result<Vec<u8>> {
        let staging = self.checked("the readback", Some(bytes), |device| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("readback"),
                size: bytes,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        })?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        copy(&mut encoder, &staging);
        let (done, mapped) = mpsc::channel();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |result| {
            // If the receiver is gone, the wait has already failed.
            let _ = done.send(result);
        });
        let submit_lock = self.submit_lock();
        self.submitted(iter::once(encoder).map(wgpu::CommandEncoder::finish), &submit_lock)?;
        match mapped.recv_timeout(self.timeout) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(self.failed(error)),
            Err(_) => return Err(self.timed_out()),
        }
        let view = staging.slice(..).get_mapped_range().map_err(|error| self.failed(error))?;
        Ok(view.to_vec())
    }

    fn submit_lock(&self) -> MutexGuard<'_, ()> {
        self.submit_lock.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn submitted(
        &self,
        commands: impl IntoIterator<Item = wgpu::CommandBuffer>,
        _submit_lock: &MutexGuard<'_, ()>,
    ) -> Result<()> {
        let mut commands = commands.into_iter();
        let mut last = None;
        while let Some(next) = self.submit_next(&mut commands)? {
            last = Some(next);
        }
        self.wait_for(last)
    }

    /// Records and submits the next command buffer, if there is one.
    fn submit_next(
        &self,
        commands: &mut impl Iterator<Item = wgpu::CommandBuffer>,
    ) -> Result<Option<wgpu::SubmissionIndex>> {
        self.checked("a frame's commands", None, |_| commands.next().map(|next| self.queue.submit([next])))
    }

    /// Waits for one submission, or for all.
    fn wait_for(&self, submission: Option<wgpu::SubmissionIndex>) -> Result<()> {
        let wait = wgpu::PollType::Wait { submission_index: submission, timeout: Some(self.timeout) };
        // wgpu 30 panics if the driver reports a loss during the wait ("Error in Device::poll"); at that point it
        // holds no lock and has called its callbacks.
        let polled = catch_unwind(AssertUnwindSafe(|| self.device.poll(wait)));
        self.check_health()?;
        match polled {
            Ok(Ok(_)) => Ok(()),
            Ok(Err(wgpu::PollError::Timeout)) => Err(self.timed_out()),
            Ok(Err(error)) => Err(Error::Device(error.to_string())),
            // The panic's message is the only report if the caller does not forward losses (`Gpu::on_lost`).
            Err(panic) => match panic.downcast::<String>() {
                Ok(message) => Err(Error::Device(*message)),
                Err(panic) => resume_unwind(panic),
            },
        }
    }

    fn timed_out(&self) -> Error {
        // Dropping the last handle of a queue waits for the device without a timeout, so this handle is leaked.
        mem::forget(self.queue.clone());
        Error::Timeout { adapter: self.facts.info.name.clone(), waited: self.timeout }
    }
}

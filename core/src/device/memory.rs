//! Allocates device memory with error scopes around the calls.

use super::Gpu;
use crate::{Error, Result};

impl Gpu {
    /// Runs calls that create `what`, of `bytes` bytes if known, and turns their errors into results.
    ///
    /// # Errors
    /// [`Error::Lost`], [`Error::OutOfMemory`], or [`Error::Device`] with the device's message.
    pub(crate) fn checked<T>(
        &self,
        what: &str,
        bytes: Option<u64>,
        calls: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T> {
        let scopes = [
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
            // Errors of the driver's own compiler.
            wgpu::ErrorFilter::Internal,
        ]
        .map(|filter| self.device.push_error_scope(filter));
        let result = calls(&self.device);
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        // An out-of-memory error is the cause of the others; its scope comes first.
        let error = errors.last();
        self.check_health()?;
        match error {
            None => Ok(result),
            Some(error) => Err(self.refused(what, bytes, &error)),
        }
    }

    /// Creates a buffer of zeros that is only accessed on the device.
    pub(crate) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer> {
        self.make_buffer(label, bytes, usage, &[])
    }

    /// Creates a storage buffer with this content.
    pub(crate) fn storage<T: bytemuck::NoUninit>(&self, label: &str, content: &[T]) -> Result<wgpu::Buffer> {
        self.filled(label, bytemuck::cast_slice(content), wgpu::BufferUsages::STORAGE)
    }

    /// Creates a buffer with this content.
    pub(crate) fn filled(
        &self,
        label: &str,
        content: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer> {
        self.make_buffer(label, content.len() as u64, usage, content)
    }

    fn make_buffer(
        &self,
        label: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
        content: &[u8],
    ) -> Result<wgpu::Buffer> {
        self.check_binding(label, bytes)?;
        self.checked(&format!("buffer `{label}`"), Some(bytes), |device| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.next_multiple_of(4).max(16),
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: !content.is_empty(),
            });
            if !content.is_empty() {
                // If mapping fails, the buffer was not created, and an error scope reports why.
                if let Ok(mut mapped) = buffer.slice(..).get_mapped_range_mut() {
                    mapped.slice(..content.len()).copy_from_slice(content);
                }
                buffer.unmap();
            }
            buffer
        })
    }

    /// Checks that a binding of `bytes` bytes is within the device's limits.
    pub(crate) fn check_binding(&self, label: &str, bytes: u64) -> Result<()> {
        let limits = self.device.limits();
        let have = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        self.check_bytes(format!("buffer `{label}`"), bytes, "in one binding", have)
    }

    /// Checks that one buffer can hold an image for readback; returns its size in bytes.
    pub(crate) fn check_readback(
        &self,
        label: &str,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> Result<u64> {
        let row = padded_row(width, format.block_copy_size(None).unwrap_or(0));
        let bytes = row * u64::from(height);
        let have = self.device.limits().max_buffer_size;
        self.check_bytes(format!("reading image `{label}` back"), bytes, "in one buffer", have)?;
        Ok(bytes)
    }

    pub(super) fn check_bytes(&self, what: String, need: u64, place: &str, have: u64) -> Result<()> {
        if need <= have {
            return Ok(());
        }
        let need = format!("{need} bytes {place}");
        Err(Error::Missing { what, need, have: have.to_string(), adapter: self.facts.info.name.clone() })
    }
}

/// Bytes between the rows of an image in a buffer, aligned as wgpu requires.
pub(super) fn padded_row(width: u32, bytes_per_texel: u32) -> u64 {
    let row = u64::from(width) * u64::from(bytes_per_texel);
    row.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}

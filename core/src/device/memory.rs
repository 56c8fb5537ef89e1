//! Memory on the device, and checked calls that make it.

use super::Gpu;
use crate::{Error, Result};

impl Gpu {
    /// Runs device calls that make `what`, which takes that many bytes if it is known.
    ///
    /// # Errors
    /// [`Error::Lost`], [`Error::OutOfMemory`], or [`Error::Device`] with the device's words.
    pub(crate) fn checked<T>(
        &self,
        what: &str,
        bytes: Option<u64>,
        calls: impl FnOnce(&wgpu::Device) -> T,
    ) -> Result<T> {
        let scopes = [
            wgpu::ErrorFilter::OutOfMemory,
            wgpu::ErrorFilter::Validation,
            // What a driver's own compiler reports.
            wgpu::ErrorFilter::Internal,
        ]
        .map(|filter| self.device.push_error_scope(filter));
        let result = calls(&self.device);
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        // Memory, the first scope, is the cause where there are several.
        let error = errors.last();
        self.check_health()?;
        match error {
            None => Ok(result),
            Some(error) => Err(self.refused(what, bytes, &error)),
        }
    }

    /// A buffer that only the device touches, filled with zeros.
    pub(crate) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer> {
        self.make_buffer(label, bytes, usage, &[])
    }

    /// A storage buffer with this content.
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
                // Without a range the buffer could not be made, and a scope knows why.
                if let Ok(mut mapped) = buffer.slice(..).get_mapped_range_mut() {
                    mapped.slice(..content.len()).copy_from_slice(content);
                }
                buffer.unmap();
            }
            buffer
        })
    }

    /// Whether one binding can hold that many bytes.
    pub(crate) fn check_binding(&self, label: &str, bytes: u64) -> Result<()> {
        let limits = self.device.limits();
        let have = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        self.check_bytes(format!("buffer `{label}`"), bytes, "in one binding", have)
    }

    /// Whether one buffer can take an image that is read back; the bytes that it takes.
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

/// Bytes from one row of an image to the next in a buffer.
pub(super) fn padded_row(width: u32, bytes_per_texel: u32) -> u64 {
    let row = u64::from(width) * u64::from(bytes_per_texel);
    row.next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}

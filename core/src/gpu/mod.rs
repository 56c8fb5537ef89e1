//! The device: which adapter, what it can, how memory comes back from it.

mod kernel;
pub(crate) mod mirror;
pub mod shader;
mod timer;

use std::{
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

pub use kernel::{Bound, Kernel};
pub use timer::Timer;

use crate::{Error, Result};

/// The longest wait for one frame; a device that needs more is taken for hung.
const PATIENCE: Duration = Duration::from_secs(600);

/// What is known of an adapter.
#[derive(Clone, Debug)]
pub struct AdapterFacts {
    /// Name, backend, driver, as wgpu reports them.
    pub info: wgpu::AdapterInfo,
    /// What the adapter offers.
    pub limits: wgpu::Limits,
    /// Whether frames are timed on the GPU.
    pub timestamps: bool,
}

impl AdapterFacts {
    fn of(adapter: &wgpu::Adapter) -> Self {
        Self {
            info: adapter.get_info(),
            limits: adapter.limits(),
            timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        }
    }
}

/// A device and its queue.
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    facts: AdapterFacts,
    /// The first error that no scope caught.
    uncaught: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// The best adapter whose name contains `wanted` (any case), without a window: hardware before software.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists what there is.
    pub fn headless(wanted: Option<&str>) -> Result<Self> {
        Self::from_instance(&instance(), wanted)
    }

    /// As [`Gpu::headless`], from an instance of the caller's (tests with the noop backend and chosen limits).
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists what there is.
    pub fn from_instance(instance: &wgpu::Instance, wanted: Option<&str>) -> Result<Self> {
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
        let names: Vec<_> = adapters.iter().map(|a| a.get_info().name).collect();
        adapters
            .retain(|a| wanted.is_none_or(|w| a.get_info().name.to_lowercase().contains(&w.to_lowercase())));
        adapters.sort_by_key(|a| match a.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Cpu => 3,
            wgpu::DeviceType::Other => 4,
        });
        let adapter = adapters.first().ok_or_else(|| {
            Error::NoAdapter(match wanted {
                Some(wanted) if !names.is_empty() => {
                    format!("none has `{wanted}` in its name; there is {}", names.join(", "))
                }
                _ => "no Vulkan driver was found; `sh desktop/setup.sh` installs a software one".to_owned(),
            })
        })?;
        Self::from_adapter(adapter)
    }

    fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self> {
        let facts = AdapterFacts::of(adapter);
        let offered = &facts.limits;
        // The WebGPU defaults, with as much memory as there is: large scenes and frames are checked against it.
        let limits = wgpu::Limits {
            max_buffer_size: offered.max_buffer_size,
            max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
            max_texture_dimension_2d: offered.max_texture_dimension_2d,
            max_texture_array_layers: offered.max_texture_array_layers,
            ..wgpu::Limits::default()
        };
        let failed: Vec<_> = missing_limits(&limits, offered);
        if let Some((what, need, have)) = failed.first() {
            return Err(Error::Missing {
                what: format!("Glimpse ({what})"),
                need: need.to_string(),
                have: have.to_string(),
                adapter: facts.info.name.clone(),
            });
        }
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("glimpse"),
            required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|e| Error::Device(e.to_string()))?;
        log::debug!(
            "adapter {} ({}), driver {}",
            facts.info.name,
            facts.info.backend,
            facts.info.driver_info
        );
        let uncaught = Arc::new(Mutex::new(None));
        let sink = Arc::clone(&uncaught);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            sink.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error.to_string());
        }));
        Ok(Self { device, queue, facts, uncaught })
    }

    /// All adapters.
    #[must_use]
    pub fn adapters() -> Vec<AdapterFacts> {
        let adapters = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::all()));
        adapters.iter().map(AdapterFacts::of).collect()
    }

    /// This device's adapter.
    #[must_use]
    pub fn facts(&self) -> &AdapterFacts {
        &self.facts
    }

    /// The limits that this device enforces.
    #[must_use]
    pub fn limits(&self) -> wgpu::Limits {
        self.device.limits()
    }

    /// Runs device calls under error scopes.
    pub(crate) fn checked<T>(&self, calls: impl FnOnce(&wgpu::Device) -> T) -> Result<T> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = calls(&self.device);
        let error = pollster::block_on(validation.pop());
        let error = pollster::block_on(memory.pop()).or(error);
        match error {
            None => Ok(result),
            Some(error) => Err(Error::Device(error.to_string())),
        }
    }

    /// A buffer that only the device touches, filled with zeros.
    pub(crate) fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer> {
        self.check_binding(label, bytes)?;
        self.checked(|device| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes.next_multiple_of(4).max(16),
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        })
    }

    /// A storage buffer with this content.
    pub(crate) fn storage<T: bytemuck::NoUninit>(&self, label: &str, content: &[T]) -> Result<wgpu::Buffer> {
        self.filled(label, bytemuck::cast_slice(content), wgpu::BufferUsages::STORAGE)
    }

    /// A buffer with this content.
    pub(crate) fn filled(
        &self,
        label: &str,
        content: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer> {
        self.check_binding(label, content.len() as u64)?;
        self.checked(|device| {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: (content.len() as u64).next_multiple_of(4).max(16),
                usage: usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: true,
            });
            if let Ok(mut mapped) = buffer.slice(..).get_mapped_range_mut() {
                mapped.slice(..content.len()).copy_from_slice(content);
            }
            buffer.unmap();
            buffer
        })
    }

    /// Whether one binding can hold that many bytes.
    pub(crate) fn check_binding(&self, label: &str, bytes: u64) -> Result<()> {
        let limits = self.device.limits();
        let have = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if bytes <= have {
            return Ok(());
        }
        Err(Error::Missing {
            what: format!("buffer `{label}`"),
            need: format!("{bytes} bytes in one binding"),
            have: format!("{have}"),
            adapter: self.facts.info.name.clone(),
        })
    }

    /// Submits and waits until the device is done.
    pub(crate) fn submit_and_wait(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        let index = self.queue.submit([encoder.finish()]);
        self.device
            .poll(wgpu::PollType::Wait { submission_index: Some(index), timeout: Some(PATIENCE) })
            .map_err(|e| Error::Device(e.to_string()))?;
        match self.uncaught.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(error) => Err(Error::Device(error)),
        }
    }

    /// Copies a buffer (made with `COPY_SRC`) to main memory.
    pub(crate) fn read_buffer(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>> {
        self.read(buffer.size(), |encoder, staging| {
            encoder.copy_buffer_to_buffer(buffer, 0, staging, 0, buffer.size());
        })
    }

    /// Copies a texture (made with `COPY_SRC`) to main memory, rows without gaps.
    pub(crate) fn read_texture(&self, texture: &wgpu::Texture, bytes_per_texel: u32) -> Result<Vec<u8>> {
        let (width, height) = (texture.width(), texture.height());
        let row = (width * bytes_per_texel) as usize;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
        let bytes = self.read((padded * height as usize) as u64, |encoder, staging| {
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
        Ok(bytes.chunks_exact(padded).flat_map(|line| &line[..row]).copied().collect())
    }

    fn read(
        &self,
        bytes: u64,
        copy: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    ) -> Result<Vec<u8>> {
        let staging = self.checked(|device| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("readback"),
                size: bytes,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            })
        })?;
        let mut encoder = self.device.create_command_encoder(&Default::default());
        copy(&mut encoder, &staging);
        let (done, mapped) = std::sync::mpsc::channel();
        encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |result| {
            let _ = done.send(result);
        });
        self.submit_and_wait(encoder)?;
        match mapped.recv_timeout(PATIENCE) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(Error::Device(error.to_string())),
            Err(_) => return Err(Error::Device("the readback never came".to_owned())),
        }
        let view = staging.slice(..).get_mapped_range().map_err(|e| Error::Device(e.to_string()))?;
        Ok(view.to_vec())
    }
}

fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends &= wgpu::Backends::PRIMARY;
    wgpu::Instance::new(descriptor)
}

/// The limits that an adapter does not reach: name, needed, had.
fn missing_limits(need: &wgpu::Limits, have: &wgpu::Limits) -> Vec<(&'static str, u64, u64)> {
    let mut missing = Vec::new();
    need.check_limits_with_fail_fn(have, false, |name, need, have| missing.push((name, need, have)));
    missing
}

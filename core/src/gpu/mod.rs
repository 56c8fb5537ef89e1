//! The device: which adapter, what it can, how memory comes back from it.

mod health;
mod kernel;
mod lavapipe;
mod memory;
pub(crate) mod mirror;
mod pipelines;
pub mod shader;
#[cfg(test)]
mod tests;
mod timer;
mod wait;
mod words;

use std::{
    sync::{Arc, Mutex},
    time::Duration,
};

use health::Health;

pub use kernel::{Bound, Kernel, Kernels};
pub use timer::Timer;
pub(crate) use words::{TEXEL_ROW, Words};

use crate::{Error, Result};

/// The longest wait for a frame or a readback unless set otherwise. A device that needs more is taken for hung: the
/// slowest frame that is still useful (a software driver, 16384x16384) takes a few minutes.
pub const PATIENCE: Duration = Duration::from_secs(600);

/// What kernels are made for and how scene data is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tier {
    /// A software device: scene data in images, which it reads a vector at a time, and workgroups dealt out so that the
    /// ranges which its cores take cost alike.
    Cpu,
    /// Any other device: scene data in storage buffers, workgroups in order.
    Gpu,
}

impl Tier {
    fn of(device: wgpu::DeviceType) -> Self {
        if device == wgpu::DeviceType::Cpu { Self::Cpu } else { Self::Gpu }
    }

    /// Scene data is stored in images, not in buffers.
    pub(crate) fn stores_images(self) -> bool {
        self == Self::Cpu
    }

    /// Workgroups are dealt out in strides, not in order.
    pub(crate) fn deals_workgroups(self) -> bool {
        self == Self::Cpu
    }
}

/// What an adapter reports of itself.
#[derive(Clone, Debug)]
pub struct AdapterFacts {
    /// Name, backend, driver, as wgpu reports them.
    pub info: wgpu::AdapterInfo,
    /// The limits that the adapter supports.
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

/// A device and its queue. Threads may share it; they take turns at waiting for it.
///
/// A device that is lost stays lost: every call on what was made from it gives [`Error::Lost`]. A program recovers by a
/// new `Gpu`, [`crate::GpuScene::upload`] and [`crate::Renderer::new`], which make the same pictures again.
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    adapter: wgpu::Adapter,
    facts: AdapterFacts,
    health: Arc<Health>,
    patience: Duration,
    /// Held from a submission until its result has been copied: whoever polls a lost device frees its buffers, those
    /// that another thread has mapped included.
    turn: Mutex<()>,
    /// Pipelines that the driver compiled in earlier runs.
    compiled: Option<wgpu::PipelineCache>,
    /// Whether the device is a CPU, for which other kernels are linked.
    pub(crate) tier: Tier,
}

impl Gpu {
    /// The best adapter whose name contains `wanted` (any case), without a window: hardware before software.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists what there is.
    pub fn headless(wanted: Option<&str>) -> Result<Self> {
        Self::from_instance(&instance(), wanted)
    }

    /// As [`Gpu::from_instance`], of the adapters that can show pictures on a surface, and with no more than `limits`
    /// whatever the adapter offers (the phone that is emulated).
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists what there is; [`Error::Missing`] names the limit that is too low.
    pub fn for_surface(
        instance: &wgpu::Instance,
        wanted: Option<&str>,
        surface: Option<&wgpu::Surface<'_>>,
        limits: Option<&wgpu::Limits>,
    ) -> Result<Self> {
        let shows = |adapter: &wgpu::Adapter| surface.is_none_or(|s| adapter.is_surface_supported(s));
        Self::from_adapter(best_adapter(instance, wanted, shows)?, limits)
    }

    /// As [`Gpu::headless`], from an instance of the caller's (tests with the noop backend and chosen limits).
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists what there is.
    pub fn from_instance(instance: &wgpu::Instance, wanted: Option<&str>) -> Result<Self> {
        Self::for_surface(instance, wanted, None, None)
    }

    fn from_adapter(adapter: wgpu::Adapter, most: Option<&wgpu::Limits>) -> Result<Self> {
        let facts = AdapterFacts::of(&adapter);
        lavapipe::check_cache(&facts.info.driver, |name| {
            std::env::var_os(name).is_some_and(|v| !v.is_empty())
        })?;
        let offered = match most {
            Some(most) => facts.limits.clone().or_worse_values_from(most),
            None => facts.limits.clone(),
        };
        // The WebGPU defaults, with as much memory as there is: large scenes and frames are checked against it.
        let limits = wgpu::Limits {
            max_buffer_size: offered.max_buffer_size,
            max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
            max_texture_dimension_2d: offered.max_texture_dimension_2d,
            max_texture_array_layers: offered.max_texture_array_layers,
            ..wgpu::Limits::default()
        };
        let failed: Vec<_> = missing_limits(&limits, &offered);
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
            required_features: adapter.features()
                & (wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::PIPELINE_CACHE),
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|error| {
            let name = &facts.info.name;
            Error::NoAdapter(format!("`{name}` gives no device ({error}); try another --adapter"))
        })?;
        log::debug!(
            "adapter {} ({}), driver {}",
            facts.info.name,
            facts.info.backend,
            facts.info.driver_info
        );
        let health = Health::watch(&device);
        let turn = Mutex::new(());
        let tier = Tier::of(facts.info.device_type);
        Ok(Self { device, queue, adapter, facts, health, patience: PATIENCE, turn, compiled: None, tier })
    }

    /// With the kernels that a GPU gets, even if it is none: for tests of them where there is no GPU.
    #[must_use]
    pub fn as_hardware(self) -> Self {
        Self { tier: Tier::Gpu, ..self }
    }

    /// Waits at most that long for a frame or a readback ([`PATIENCE`]).
    #[must_use]
    pub fn with_patience(self, patience: Duration) -> Self {
        Self { patience, ..self }
    }

    /// Gives the device up, as a driver does that resets it: from here on everything made from it gives
    /// [`Error::Lost`]. For tests of recovery, and for programs that must free a device's memory at once.
    pub fn destroy(&self) {
        self.health.lose("it was destroyed".to_owned());
        self.device.destroy();
    }

    /// Why the device is lost, if it is. It may be lost the moment after.
    #[must_use]
    pub fn lost(&self) -> Option<&str> {
        self.health.lost.get().map(String::as_str)
    }

    /// Lists all adapters of the machine.
    #[must_use]
    pub fn adapters() -> Vec<AdapterFacts> {
        let adapters = pollster::block_on(instance().enumerate_adapters(wgpu::Backends::all()));
        adapters.iter().map(AdapterFacts::of).collect()
    }

    /// What the adapter of this device reports.
    #[must_use]
    pub fn facts(&self) -> &AdapterFacts {
        &self.facts
    }

    /// The device, for what shows the frames.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Its queue: what is submitted to it comes between the submissions of a frame.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// The adapter, which knows the formats of a surface.
    #[must_use]
    pub fn adapter(&self) -> &wgpu::Adapter {
        &self.adapter
    }

    /// The limits that this device enforces.
    #[must_use]
    pub fn limits(&self) -> wgpu::Limits {
        self.device.limits()
    }
}

/// Of the backends that are Vulkan's kind: others' compute is not enough.
#[must_use]
pub fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends &= wgpu::Backends::PRIMARY;
    wgpu::Instance::new(descriptor)
}

/// Hardware before software, among those whose name contains `wanted` and that `serve`.
fn best_adapter(
    instance: &wgpu::Instance,
    wanted: Option<&str>,
    serves: impl Fn(&wgpu::Adapter) -> bool,
) -> Result<wgpu::Adapter> {
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    adapters.retain(serves);
    let names: Vec<_> = adapters.iter().map(|a| a.get_info().name).collect();
    adapters.retain(|a| wanted.is_none_or(|w| a.get_info().name.to_lowercase().contains(&w.to_lowercase())));
    adapters.sort_by_key(|a| match a.get_info().device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Cpu => 3,
        wgpu::DeviceType::Other => 4,
    });
    adapters.into_iter().next().ok_or_else(|| {
        Error::NoAdapter(match wanted {
            Some(wanted) if !names.is_empty() => {
                format!("none has `{wanted}` in its name; there is {}", names.join(", "))
            }
            _ => "no Vulkan driver was found; `sh desktop/setup.sh` installs a software one".to_owned(),
        })
    })
}

/// The limits that an adapter does not reach: name, needed, had.
fn missing_limits(need: &wgpu::Limits, have: &wgpu::Limits) -> Vec<(&'static str, u64, u64)> {
    let mut missing = Vec::new();
    need.check_limits_with_fail_fn(have, false, |name, need, have| missing.push((name, need, have)));
    missing
}

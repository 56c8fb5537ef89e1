//! The device: choice of an adapter, limits, device memory, submission and readback.

mod adapter;
mod ahead;
pub(crate) mod atlas;
pub(crate) mod environment;
pub(crate) mod gpu_scene;
mod health;
mod kernel;
mod lavapipe;
pub(crate) mod material_records;
mod memory;
pub(crate) mod mip;
pub(crate) mod mirror;
mod pipelines;
mod scene_storage;
pub mod shader;
#[cfg(test)]
mod tests;
mod timer;
mod wait;

use std::{
    collections::BTreeSet,
    sync::{Arc, Mutex, OnceLock},
    time::Duration,
};

use health::Health;
use kernel::KernelCache;

pub use ahead::{Compilation, Uncompiled};
pub use kernel::{Bound, Kernel, Kernels};
pub(crate) use scene_storage::{STORAGE_TEXTURE_WIDTH, SceneStorage};
pub use timer::Timer;

use crate::{Error, Result};
use adapter::{best_adapter, check_limits, used_limits};

pub use adapter::{AdapterFacts, instance};

/// Default limit of the wait for a frame or a readback, after which the device counts as hung. The slowest useful
/// frames (a software driver, 16384x16384) take a few minutes.
pub const TIMEOUT: Duration = Duration::from_secs(600);

/// The kind of device, which determines kernel variants and the storage of scene data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tier {
    /// A software device. Scene data is in images, which it reads a vector at a time; workgroups map to
    /// interleaved tiles, so that the contiguous ranges that its threads take cost about the same.
    Cpu,
    /// Any other device. Scene data is in storage buffers; workgroups map to tiles in order.
    Gpu,
}

impl Tier {
    fn of(device: wgpu::DeviceType) -> Self {
        if device == wgpu::DeviceType::Cpu { Self::Cpu } else { Self::Gpu }
    }

    /// Whether scene data is stored in images instead of buffers.
    pub(crate) fn stores_images(self) -> bool {
        self == Self::Cpu
    }

    /// Whether workgroups map to interleaved tiles instead of consecutive ones.
    pub(crate) fn deals_workgroups(self) -> bool {
        self == Self::Cpu
    }
}

/// A device and its queue. Clones are handles of the same device. Threads may share it; they take turns in
/// waiting for it.
///
/// A lost device stays lost: every call on objects created from it returns [`Error::Lost`]. To recover, create a
/// new `Gpu`, [`crate::GpuScene`] and [`crate::Renderer`]; they render the same images.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    adapter: wgpu::Adapter,
    facts: Arc<AdapterFacts>,
    health: Arc<Health>,
    timeout: Duration,
    /// Held from a submission until its result is copied: polling a lost device frees its buffers, also those
    /// that another thread has mapped.
    submit_lock: Arc<Mutex<()>>,
    /// The driver's cache of pipelines compiled in earlier runs.
    compiled: Option<wgpu::PipelineCache>,
    /// Kernels that renderers of this device have compiled.
    kernels: Arc<KernelCache>,
    /// Fingerprints of kernels that the driver's cache holds.
    in_cache: Arc<Mutex<BTreeSet<u64>>>,
    /// The device that compiles kernels ahead of frames, made when first needed.
    second: Arc<OnceLock<Option<Box<Gpu>>>>,
    /// The kind of device that kernels and scene data are made for.
    pub(crate) tier: Tier,
}

impl Gpu {
    /// Opens the best adapter whose name contains `wanted`, ignoring case, without a window; hardware before
    /// software.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists the adapters found.
    pub fn headless(wanted: Option<&str>) -> Result<Self> {
        Self::from_instance(&instance(), wanted)
    }

    /// Like [`Gpu::from_instance`], but considers only adapters that can present to a surface, and restricts the
    /// device to `limits`, for example to emulate a phone.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists the adapters found; [`Error::Missing`] names the limit that is too low.
    pub fn for_surface(
        instance: &wgpu::Instance,
        wanted: Option<&str>,
        surface: Option<&wgpu::Surface<'_>>,
        limits: Option<&wgpu::Limits>,
    ) -> Result<Self> {
        let shows = |adapter: &wgpu::Adapter| surface.is_none_or(|s| adapter.is_surface_supported(s));
        Self::from_adapter(best_adapter(instance, wanted, shows)?, limits)
    }

    /// Like [`Gpu::headless`], but with the caller's instance (used by tests with the noop backend and chosen
    /// limits).
    ///
    /// # Errors
    /// [`Error::NoAdapter`] lists the adapters found.
    pub fn from_instance(instance: &wgpu::Instance, wanted: Option<&str>) -> Result<Self> {
        Self::for_surface(instance, wanted, None, None)
    }

    fn from_adapter(adapter: wgpu::Adapter, most: Option<&wgpu::Limits>) -> Result<Self> {
        let facts = AdapterFacts::of(&adapter);
        let offered = match most {
            Some(most) => facts.limits.clone().or_worse_values_from(most),
            None => facts.limits.clone(),
        };
        check_limits(&facts, &offered)?;
        let descriptor =
            wgpu::DeviceDescriptor { required_limits: used_limits(&offered), ..Self::requirements(&adapter) };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
            let name = &facts.info.name;
            Error::NoAdapter(format!("`{name}` gives no device ({error})"))
        })?;
        let gpu = Self::new(adapter, device, queue, facts)?;
        gpu.health.watch(&gpu.device);
        Ok(gpu)
    }

    /// Renders on a device of the caller, which must meet [`Gpu::requirements`] and may be used for other work as
    /// well. Frames are timed if it has [`wgpu::Features::TIMESTAMP_QUERY`]. The handles are cloned.
    ///
    /// The device's callbacks stay the caller's. Errors of this crate's calls are caught by error scopes and
    /// returned, so they do not reach the handler of uncaptured errors. A device has only one callback for its
    /// loss, which the caller must forward:
    ///
    /// ```no_run
    /// # use glimpse::{Gpu, wgpu};
    /// # fn example(adapter: wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> glimpse::Result<()> {
    /// let gpu = Gpu::from_device(&adapter, &device, &queue)?;
    /// let on_lost = gpu.on_lost();
    /// device.set_device_lost_callback(move |reason, message| {
    ///     on_lost(reason, message);
    ///     // What else there is to do.
    /// });
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// Without this a loss is noticed late, and some calls return [`Error::Device`] instead of [`Error::Lost`].
    ///
    /// # Errors
    /// [`Error::Missing`] names every limit of the device that is too low.
    pub fn from_device(adapter: &wgpu::Adapter, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self> {
        let timestamps = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let facts = AdapterFacts { timestamps, ..AdapterFacts::of(adapter) };
        check_limits(&facts, &device.limits())?;
        Self::new(adapter.clone(), device.clone(), queue.clone(), facts)
    }

    /// The descriptor of a device for [`Gpu::from_device`]: WebGPU's default limits with buffers and images as
    /// large as the adapter allows, and timestamps and a pipeline cache if the adapter has them. Callers add what
    /// else they need.
    #[must_use]
    pub fn requirements(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        wgpu::DeviceDescriptor {
            label: Some("glimpse"),
            required_features: adapter.features()
                & (wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::PIPELINE_CACHE),
            required_limits: used_limits(&adapter.limits()),
            ..Default::default()
        }
    }

    fn new(
        adapter: wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
        facts: AdapterFacts,
    ) -> Result<Self> {
        lavapipe::check_cache(&facts.info.driver, lavapipe::is_set)?;
        let wgpu::AdapterInfo { name, backend, driver_info, .. } = &facts.info;
        log::debug!("adapter {name} ({backend}), driver {driver_info}");
        Ok(Self {
            tier: Tier::of(facts.info.device_type),
            device,
            queue,
            adapter,
            facts: Arc::new(facts),
            health: Arc::default(),
            timeout: TIMEOUT,
            submit_lock: Arc::default(),
            compiled: None,
            kernels: Arc::default(),
            second: Arc::default(),
            in_cache: Arc::default(),
        })
    }

    /// Uses the kernels and storage for GPUs on any device, to test them where there is no GPU.
    #[must_use]
    pub fn as_hardware(self) -> Self {
        Self { tier: Tier::Gpu, ..self }
    }

    /// Sets the longest wait for a frame or a readback; the default is [`TIMEOUT`].
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Drops compiled kernels that no renderer uses, for a system that is short of memory.
    pub fn trim(&self) {
        self.kernels.trim();
    }

    /// Destroys the device, as if a driver had reset it: everything created from it then returns [`Error::Lost`].
    /// Used to test recovery, or to free device memory immediately.
    pub fn destroy(&self) {
        self.health.lose("it was destroyed".to_owned());
        self.device.destroy();
    }

    /// The callback by which the owner of a device reports its loss; see [`Gpu::from_device`]. It holds no handle
    /// of the device.
    pub fn on_lost(&self) -> impl Fn(wgpu::DeviceLostReason, String) + Send + Sync + use<> {
        self.health.on_lost()
    }

    /// The reason for the loss if the device is lost. It may be lost right after the call.
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

    /// The properties of this device's adapter.
    #[must_use]
    pub fn facts(&self) -> &AdapterFacts {
        &self.facts
    }

    /// The wgpu device, for example to present frames.
    #[must_use]
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// The wgpu queue. Work submitted to it may run between the submissions of a frame.
    #[must_use]
    pub fn queue(&self) -> &wgpu::Queue {
        &self.queue
    }

    /// The wgpu adapter, which reports the formats that a surface supports.
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

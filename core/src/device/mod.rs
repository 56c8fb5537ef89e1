//! The device: which adapter, what it can, how memory comes back from it.

mod adapter;
pub(crate) mod atlas;
pub(crate) mod gpu_scene;
mod health;
mod kernel;
mod lavapipe;
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
    sync::{Arc, Mutex},
    time::Duration,
};

use health::Health;

pub use kernel::{Bound, Kernel, Kernels};
pub(crate) use scene_storage::{STORAGE_TEXTURE_WIDTH, SceneStorage};
pub use timer::Timer;

use crate::{Error, Result};
use adapter::{best_adapter, check_limits, used_limits};

pub use adapter::{AdapterFacts, instance};

/// The longest wait for a frame or a readback unless set otherwise. A device that needs more is taken for hung: the
/// slowest frame that is still useful (a software driver, 16384x16384) takes a few minutes.
pub const TIMEOUT: Duration = Duration::from_secs(600);

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

/// A device and its queue. Threads may share it; they take turns at waiting for it. A clone is another handle to the same
/// device.
///
/// A device that is lost stays lost: every call on what was made from it gives [`Error::Lost`]. A program recovers by a
/// new `Gpu`, [`crate::GpuScene::upload`] and [`crate::Renderer::new`], which make the same pictures again.
#[derive(Clone)]
pub struct Gpu {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    adapter: wgpu::Adapter,
    facts: Arc<AdapterFacts>,
    health: Arc<Health>,
    timeout: Duration,
    /// Held from a submission until its result has been copied: whoever polls a lost device frees its buffers, those
    /// that another thread has mapped included.
    submit_lock: Arc<Mutex<()>>,
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

    /// Renders on a device of the caller's, made with at least what [`Gpu::requirements`] asks for, beside whatever else it
    /// does. Frames are timed if it has [`wgpu::Features::TIMESTAMP_QUERY`]. The handles are cloned.
    ///
    /// Its callbacks stay the caller's: an error of a call of this crate's is caught by an error scope and returned, and
    /// does not come to the handler of uncaptured errors. A loss is told to one callback alone, which the caller passes on:
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
    /// Without it a loss is noticed late, and some calls give [`Error::Device`] in place of [`Error::Lost`].
    ///
    /// # Errors
    /// [`Error::Missing`] names every limit of the device that is too low.
    pub fn from_device(adapter: &wgpu::Adapter, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self> {
        let timestamps = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let facts = AdapterFacts { timestamps, ..AdapterFacts::of(adapter) };
        check_limits(&facts, &device.limits())?;
        Self::new(adapter.clone(), device.clone(), queue.clone(), facts)
    }

    /// What a device of this adapter's should have for [`Gpu::from_device`]: WebGPU's default limits, with buffers and images
    /// as large as the adapter lets them be, for large scenes and frames; timestamps and a cache of pipelines if it can. A
    /// caller adds what else it needs.
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
        })
    }

    /// With the kernels that a GPU gets, even if it is none: for tests of them where there is no GPU.
    #[must_use]
    pub fn as_hardware(self) -> Self {
        Self { tier: Tier::Gpu, ..self }
    }

    /// Waits at most that long for a frame or a readback ([`TIMEOUT`]).
    #[must_use]
    pub fn with_timeout(self, timeout: Duration) -> Self {
        Self { timeout, ..self }
    }

    /// Gives the device up, as a driver does that resets it: from here on everything made from it gives
    /// [`Error::Lost`]. For tests of recovery, and for programs that must free a device's memory at once.
    pub fn destroy(&self) {
        self.health.lose("it was destroyed".to_owned());
        self.device.destroy();
    }

    /// What a caller with a device of its own tells of its loss: see [`Gpu::from_device`]. It holds no handle to the device.
    pub fn on_lost(&self) -> impl Fn(wgpu::DeviceLostReason, String) + Send + Sync + use<> {
        self.health.on_lost()
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

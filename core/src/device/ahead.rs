//! Compiles kernels before the frame that needs them.
//!
//! Drivers of GPUs compile a kernel when its pipeline is created, on the thread that creates it. Software drivers do so
//! when it is first dispatched, on the thread of the queue, which then executes nothing else: a window on that queue
//! stands still. There a second device of the same adapter compiles each kernel first, by a dispatch of no workgroups,
//! and the first device finds the result in the driver's cache. What an earlier run has compiled is left to the first.

use std::{
    collections::BTreeSet,
    hash::{DefaultHasher, Hash, Hasher},
    sync::{MutexGuard, PoisonError},
};

use wgpu::naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, StorageFormat, TypeInner};

use super::{
    Gpu, Tier,
    kernel::Kernel,
    shader::{Linked, Source, link},
};
use crate::Result;

/// Bytes of the buffers that are bound while nothing is dispatched: more than any kernel requires at least.
const PLACEHOLDER_BYTES: u64 = 1 << 14;

/// Kernels that a renderer needs and the device has not compiled yet. Frames of other renderers go on while another thread
/// compiles them.
pub struct Compilation {
    gpu: Gpu,
    waiting: Vec<(&'static str, Vec<Source>)>,
    total: usize,
}

impl Compilation {
    /// The kernels of this list that the device does not have, each by its label and sources.
    pub(crate) fn new(gpu: &Gpu, kernels: Vec<(&'static str, Vec<Source>)>) -> Self {
        let mut waiting: Vec<(_, Vec<_>)> = Vec::new();
        for (label, sources) in kernels {
            if !gpu.kernels.has(&sources) && waiting.iter().all(|(_, other)| *other != sources) {
                waiting.push((label, sources));
            }
        }
        waiting.reverse();
        Self { gpu: gpu.clone(), total: waiting.len(), waiting }
    }

    /// Number of kernels that waited at first.
    #[must_use]
    pub fn total(&self) -> usize {
        self.total
    }

    /// Number of kernels that still wait.
    #[must_use]
    pub fn remaining(&self) -> usize {
        self.waiting.len()
    }

    /// Takes the next kernel off the list that the device does not have by now.
    pub fn take_next(&mut self) -> Option<Uncompiled> {
        let (label, sources) =
            std::iter::from_fn(|| self.waiting.pop()).find(|(_, sources)| !self.gpu.kernels.has(sources))?;
        Some(Uncompiled { gpu: self.gpu.clone(), label, sources })
    }

    /// Compiles the next kernel; does nothing if none waits.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] if the driver cannot compile it, or the device failed.
    pub fn compile_next(&mut self) -> Result<()> {
        let Some(kernel) = self.take_next() else { return Ok(()) };
        kernel.dispatch_apart()?;
        kernel.create()
    }
}

/// A kernel that a device has not compiled. Its two steps may run side by side; a frame needs both.
pub struct Uncompiled {
    gpu: Gpu,
    label: &'static str,
    sources: Vec<Source>,
}

impl Uncompiled {
    /// Has a second device compile the kernel for the driver's cache, where creating a pipeline does not.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] if the driver cannot compile it, or the device failed.
    pub fn dispatch_apart(&self) -> Result<()> {
        let fingerprint = self.fingerprint();
        if self.gpu.in_cache().contains(&fingerprint) {
            return Ok(());
        }
        let Some(second) = self.gpu.second() else { return Ok(()) };
        let linked = link(&self.sources)?;
        if let Some(resources) = placeholders(second, &linked)? {
            dispatch_nothing(second, &Kernel::of_linked(second, self.label, &linked)?, &resources)?;
            self.gpu.in_cache().insert(fingerprint);
        }
        Ok(())
    }

    /// A number that differs where sources, adapter or driver do.
    fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        let wgpu::AdapterInfo { name, driver, driver_info, .. } = &self.gpu.facts().info;
        (name, driver, driver_info, &self.sources).hash(&mut hasher);
        hasher.finish()
    }

    /// Creates the kernel's pipeline.
    ///
    /// # Errors
    /// [`crate::Error::Shader`] if the driver cannot compile it, or the device failed.
    pub fn create(&self) -> Result<()> {
        self.gpu.kernels.keep(&self.sources, Kernel::new(&self.gpu, self.label, &self.sources)?);
        Ok(())
    }
}

impl Gpu {
    /// Tells which kernels earlier runs left in the driver's cache ([`Gpu::cached_kernels`]): they are not compiled by a
    /// second device again. A wrong entry only holds up the queue while the kernel is compiled.
    pub fn add_cached_kernels(&self, fingerprints: impl IntoIterator<Item = u64>) {
        self.in_cache().extend(fingerprints);
    }

    /// Fingerprints of the kernels that the driver's cache holds as far as is known, in ascending order.
    #[must_use]
    pub fn cached_kernels(&self) -> Vec<u64> {
        self.in_cache().iter().copied().collect()
    }

    fn in_cache(&self) -> MutexGuard<'_, BTreeSet<u64>> {
        self.in_cache.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The device that compiles kernels; `None` where creating a pipeline does, or where the driver gives no second one.
    fn second(&self) -> Option<&Self> {
        let limits = self.device.limits();
        let second = || Self::from_adapter(self.adapter.clone(), Some(&limits)).ok().map(Box::new);
        (self.tier == Tier::Cpu).then(|| self.second.get_or_init(second).as_deref()).flatten()
    }
}

/// Dispatches no workgroups of a kernel and waits for that.
fn dispatch_nothing(gpu: &Gpu, kernel: &Kernel, resources: &[Placeholder]) -> Result<()> {
    let resources: Vec<_> =
        resources.iter().map(|(name, resource)| (name.as_str(), resource.binding())).collect();
    let bound = gpu.checked("placeholders", None, |device| kernel.bind(device, &resources))??;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    bound.dispatch(&mut encoder.begin_compute_pass(&Default::default()), [0, 0]);
    gpu.submit_and_wait(encoder)
}

/// A resource by its name in WGSL.
type Placeholder = (String, Resource);

enum Resource {
    Buffer(wgpu::Buffer),
    Texture(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Resource {
    fn binding(&self) -> wgpu::BindingResource<'_> {
        match self {
            Self::Buffer(buffer) => buffer.as_entire_binding(),
            Self::Texture(view) => wgpu::BindingResource::TextureView(view),
            Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
        }
    }
}

/// A small resource for each that the kernel uses; `None` if some kind is not known here.
fn placeholders(gpu: &Gpu, linked: &Linked) -> Result<Option<Vec<Placeholder>>> {
    gpu.checked("placeholders", None, |device| {
        let used = linked.used_resources();
        used.map(|(name, global, _)| {
            let kind = &linked.module.types[global.ty].inner;
            Some((name.to_owned(), placeholder(device, kind, global.space)?))
        })
        .collect()
    })
}

fn placeholder(device: &wgpu::Device, kind: &TypeInner, space: AddressSpace) -> Option<Resource> {
    match (kind, space) {
        (TypeInner::Image { dim, arrayed, class }, _) => {
            let (format, usage) = match class {
                ImageClass::Sampled { kind: ScalarKind::Float, .. } => {
                    (wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureUsages::TEXTURE_BINDING)
                }
                ImageClass::Sampled { kind: ScalarKind::Uint, .. } => {
                    (wgpu::TextureFormat::Rgba32Uint, wgpu::TextureUsages::TEXTURE_BINDING)
                }
                ImageClass::Storage { format: StorageFormat::Rgba8Unorm, .. } => {
                    (wgpu::TextureFormat::Rgba8Unorm, wgpu::TextureUsages::STORAGE_BINDING)
                }
                ImageClass::Storage { format: StorageFormat::Rgba32Float, .. } => {
                    (wgpu::TextureFormat::Rgba32Float, wgpu::TextureUsages::STORAGE_BINDING)
                }
                _ => return None,
            };
            let dimension = match (dim, arrayed) {
                (ImageDimension::D2, false) => wgpu::TextureViewDimension::D2,
                (ImageDimension::D2, true) => wgpu::TextureViewDimension::D2Array,
                _ => return None,
            };
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("placeholder"),
                size: wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            });
            let view = wgpu::TextureViewDescriptor { dimension: Some(dimension), ..Default::default() };
            Some(Resource::Texture(texture.create_view(&view)))
        }
        (TypeInner::Sampler { .. }, _) => {
            Some(Resource::Sampler(device.create_sampler(&wgpu::SamplerDescriptor::default())))
        }
        (_, AddressSpace::Uniform | AddressSpace::Storage { .. }) => {
            Some(Resource::Buffer(device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("placeholder"),
                size: PLACEHOLDER_BYTES,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })))
        }
        _ => None,
    }
}

//! Compute pipelines whose resources are bound by their WGSL names.

use std::{
    borrow::Cow,
    collections::{HashMap, hash_map::Entry},
    sync::{Arc, Mutex, PoisonError},
};

use super::{
    Gpu,
    shader::{Linked, ShaderError, Source, link},
};
use crate::{Error, Result};

/// Kernels that a device keeps after the last renderer that uses them: several scenes by several methods.
pub(super) const KEPT: usize = 192;

/// The kernels of a renderer by their sources: each is compiled once and bound again when buffers change.
#[derive(Default)]
pub struct Kernels(HashMap<Vec<Source>, Arc<Kernel>>);

impl Kernels {
    /// Number of kernels that were asked for.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the kernel of these sources, compiled when the device is first asked for it.
    ///
    /// # Errors
    /// The errors of [`Kernel::new`].
    pub fn get(&mut self, gpu: &Gpu, label: &str, sources: Vec<Source>) -> Result<Arc<Kernel>> {
        match self.0.entry(sources) {
            Entry::Occupied(known) => Ok(known.get().clone()),
            Entry::Vacant(new) => {
                let kernel = gpu.kernels.get(gpu, label, new.key())?;
                Ok(new.insert(kernel).clone())
            }
        }
    }
}

/// The kernels of a device by their sources. Those that were asked for least recently are dropped.
#[derive(Default)]
pub(super) struct KernelCache(Mutex<HashMap<Vec<Source>, Cached>>);

struct Cached {
    kernel: Arc<Kernel>,
    /// Larger than that of every entry that was asked for earlier.
    used: usize,
}

impl KernelCache {
    /// Returns the kernel of these sources. Two threads that ask for one at the same time may both compile it.
    fn get(&self, gpu: &Gpu, label: &str, sources: &[Source]) -> Result<Arc<Kernel>> {
        if let Some(kernel) = self.known(sources) {
            return Ok(kernel);
        }
        Ok(self.keep(sources, Kernel::new(gpu, label, sources)?))
    }

    /// Keeps a kernel of these sources.
    pub(super) fn keep(&self, sources: &[Source], kernel: Kernel) -> Arc<Kernel> {
        let kernel = Arc::new(kernel);
        let mut cached = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if cached.len() >= KEPT {
            let oldest =
                cached.iter().min_by_key(|(_, entry)| entry.used).map(|(sources, _)| sources.clone());
            oldest.and_then(|sources| cached.remove(&sources));
        }
        let used = next_use(&cached);
        cached.insert(sources.to_vec(), Cached { kernel: kernel.clone(), used });
        kernel
    }

    /// Whether these sources were asked for before.
    pub(super) fn has(&self, sources: &[Source]) -> bool {
        self.known(sources).is_some()
    }

    fn known(&self, sources: &[Source]) -> Option<Arc<Kernel>> {
        let mut cached = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let used = next_use(&cached);
        let entry = cached.get_mut(sources)?;
        entry.used = used;
        Some(entry.kernel.clone())
    }

    /// Drops the kernels that no renderer uses.
    pub fn trim(&self) {
        let mut cached = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        cached.retain(|_, entry| Arc::strong_count(&entry.kernel) > 1);
    }
}

fn next_use(cached: &HashMap<Vec<Source>, Cached>) -> usize {
    cached.values().map(|entry| entry.used + 1).max().unwrap_or_default()
}

/// A compute pipeline with entry point `main`.
pub struct Kernel {
    label: String,
    pipeline: wgpu::ComputePipeline,
    slots: HashMap<String, u32>,
}

impl Kernel {
    /// Links the sources, validates the module and creates the compute pipeline.
    ///
    /// # Errors
    /// [`Error::Shader`] if naga or the driver cannot compile it, or the device failed.
    pub fn new(gpu: &Gpu, label: &str, sources: &[Source]) -> Result<Self> {
        let files: Vec<_> = sources.iter().map(|source| source.file).collect();
        let kernel = Self::of_linked(gpu, label, &link(sources)?)?;
        log::debug!("kernel {label}: {} resources, linked from {}", kernel.slots.len(), files.join(", "));
        Ok(kernel)
    }

    /// Creates the compute pipeline of a linked module.
    ///
    /// # Errors
    /// [`Error::Shader`] if the driver cannot compile it, or the device failed.
    pub(super) fn of_linked(gpu: &Gpu, label: &str, linked: &Linked) -> Result<Self> {
        let slots: HashMap<_, _> =
            linked.used_resources().map(|(name, _, number)| (name.to_owned(), number)).collect();
        let pipeline = gpu.checked(&format!("kernel `{label}`"), None, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(Cow::Owned(linked.module.clone())),
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    zero_initialize_workgroup_memory: false,
                    ..Default::default()
                },
                cache: gpu.compiled.as_ref(),
            })
        });
        let pipeline = pipeline.map_err(|error| match error {
            Error::Device(message) => ShaderError::Refused {
                kernel: label.to_owned(),
                adapter: gpu.facts().info.name.clone(),
                message,
            }
            .into(),
            // Drivers that cannot compile a kernel may lose the device.
            Error::Lost { adapter, reason } => {
                Error::Lost { adapter, reason: format!("{reason} while compiling kernel `{label}`") }
            }
            other => other,
        })?;
        Ok(Self { label: label.to_owned(), pipeline, slots })
    }

    /// Creates the bind group with those of the given resources that the shader uses.
    ///
    /// # Errors
    /// [`ShaderError::Bindings`] if a used resource is missing.
    pub fn bind(
        &self,
        device: &wgpu::Device,
        resources: &[(&str, wgpu::BindingResource<'_>)],
    ) -> Result<Bound> {
        let entries: Vec<_> = resources
            .iter()
            .filter_map(|(name, resource)| {
                let binding = *self.slots.get(*name)?;
                Some(wgpu::BindGroupEntry { binding, resource: resource.clone() })
            })
            .collect();
        if entries.len() != self.slots.len() {
            let sorted = |names: Vec<String>| {
                let mut names = names;
                names.sort();
                names
            };
            return Err(ShaderError::Bindings {
                kernel: self.label.clone(),
                given: sorted(resources.iter().map(|(name, _)| (*name).to_owned()).collect()),
                used: sorted(self.slots.keys().cloned().collect()),
            }
            .into());
        }
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.label),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Ok(Bound { pipeline: self.pipeline.clone(), group })
    }
}

/// A pipeline with its bind group, ready to dispatch.
#[derive(Clone)]
pub struct Bound {
    pipeline: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
}

impl Bound {
    /// Dispatches `x * y` workgroups.
    pub fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>, [x, y]: [u32; 2]) {
        self.set(pass);
        pass.dispatch_workgroups(x, y, 1);
    }

    /// Dispatches the number of workgroups that the buffer holds at byte `offset`.
    pub fn dispatch_indirect(&self, pass: &mut wgpu::ComputePass<'_>, arguments: &wgpu::Buffer, offset: u64) {
        self.set(pass);
        pass.dispatch_workgroups_indirect(arguments, offset);
    }

    fn set(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
    }
}

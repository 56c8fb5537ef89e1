//! Compute pipelines whose resources are bound by their WGSL names.

use std::{
    borrow::Cow,
    collections::{HashMap, hash_map::Entry},
    sync::Arc,
};

use super::{
    Gpu,
    shader::{Linked, ShaderError, Source, link},
};
use crate::{Error, Result};

/// A cache of kernels by their sources: each is compiled once and bound again when buffers change.
#[derive(Default)]
pub struct Kernels(HashMap<Vec<Source>, Arc<Kernel>>);

impl Kernels {
    /// Number of compiled kernels.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// Returns the kernel of these sources, compiled on first use.
    ///
    /// # Errors
    /// The errors of [`Kernel::new`].
    pub fn get(&mut self, gpu: &Gpu, label: &str, sources: Vec<Source>) -> Result<Arc<Kernel>> {
        match self.0.entry(sources) {
            Entry::Occupied(known) => Ok(known.get().clone()),
            Entry::Vacant(new) => {
                let kernel = Arc::new(Kernel::new(gpu, label, new.key())?);
                Ok(new.insert(kernel).clone())
            }
        }
    }
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
        let linked = link(sources)?;
        let slots: HashMap<_, _> =
            linked.used_resources().map(|(name, _, number)| (name.to_owned(), number)).collect();
        let Linked { module, .. } = linked;
        let pipeline = gpu.checked(&format!("kernel `{label}`"), None, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Naga(Cow::Owned(module)),
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
        let files: Vec<_> = sources.iter().map(|source| source.file).collect();
        log::debug!("kernel {label}: {} resources, linked from {}", slots.len(), files.join(", "));
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

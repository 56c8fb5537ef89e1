//! Adapters: which there are, what they offer and what of it is used.

use crate::{Error, Result};

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
    pub(super) fn of(adapter: &wgpu::Adapter) -> Self {
        Self {
            info: adapter.get_info(),
            limits: adapter.limits(),
            timestamps: adapter.features().contains(wgpu::Features::TIMESTAMP_QUERY),
        }
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
pub(super) fn best_adapter(
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

/// What is used of limits that are offered: WebGPU's defaults, with as much memory as there is. Large scenes and frames are
/// checked against it.
pub(super) fn used_limits(offered: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_buffer_size: offered.max_buffer_size,
        max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
        max_texture_dimension_2d: offered.max_texture_dimension_2d,
        max_texture_array_layers: offered.max_texture_array_layers,
        ..wgpu::Limits::default()
    }
}

/// Whether all limits are as high as what is used of them.
///
/// # Errors
/// [`Error::Missing`] names those that are not.
pub(super) fn check_limits(facts: &AdapterFacts, offered: &wgpu::Limits) -> Result<()> {
    let mut missing: [Vec<String>; 2] = Default::default();
    used_limits(offered).check_limits_with_fail_fn(offered, false, |name, need, have| {
        let [needs, has] = &mut missing;
        needs.push(format!("{name} {need}"));
        has.push(have.to_string());
    });
    let [need, have] = missing.map(|values| values.join(", "));
    if need.is_empty() {
        return Ok(());
    }
    Err(Error::Missing { what: "Glimpse".to_owned(), need, have, adapter: facts.info.name.clone() })
}

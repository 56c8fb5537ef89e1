//! Adapters: enumeration, choice, and the limits that are required of them.

use crate::{Error, Result};

/// The properties that an adapter reports.
#[derive(Clone, Debug)]
pub struct AdapterFacts {
    /// Name, backend and driver, as wgpu reports them.
    pub info: wgpu::AdapterInfo,
    /// The limits that the adapter supports, before any are lowered.
    pub limits: wgpu::Limits,
    /// Whether the adapter has timestamp queries, which GPU times need.
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

/// An instance of the primary backends (Vulkan, Metal, DX12, WebGPU); others lack the needed compute support.
#[must_use]
pub fn instance() -> wgpu::Instance {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    descriptor.backends &= wgpu::Backends::PRIMARY;
    wgpu::Instance::new(descriptor)
}

/// The best adapter that `serves` accepts and whose name contains `wanted`, ignoring case: hardware before
/// software.
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

/// The limits that a device is created with: WebGPU's defaults, with buffers and images as large as the adapter
/// offers. Large scenes and frames are checked against them.
pub(super) fn used_limits(offered: &wgpu::Limits) -> wgpu::Limits {
    wgpu::Limits {
        max_buffer_size: offered.max_buffer_size,
        max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
        max_texture_dimension_2d: offered.max_texture_dimension_2d,
        max_texture_array_layers: offered.max_texture_array_layers,
        ..wgpu::Limits::default()
    }
}

/// Checks that all offered limits are at least as high as the required ones.
///
/// # Errors
/// [`Error::Missing`] names the limits that are too low.
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

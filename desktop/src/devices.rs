//! `glimpse devices`: lists the adapters with the limits that matter to Glimpse.

use glimpse::Gpu;
use glimpse::device::AdapterFacts;
use glimpse_measure::statistics::AdapterStatistics;
use serde::Serialize;

use crate::args::DevicesOptions;
use crate::output::{self, bytes, grouped};
use crate::summary::row;

/// An adapter in the output of `--json`.
#[derive(Serialize)]
struct Device {
    #[serde(flatten)]
    adapter: AdapterStatistics,
    kind: String,
    timestamps: bool,
    limits: Limits,
}

#[derive(Serialize)]
struct Limits {
    storage_buffers_per_stage: u32,
    storage_binding_bytes: u64,
    buffer_bytes: u64,
    workgroup_memory_bytes: u32,
    workgroup_invocations: u32,
    workgroups_per_dimension: u32,
    texture_side: u32,
}

impl From<&AdapterFacts> for Device {
    fn from(facts: &AdapterFacts) -> Self {
        let limits = &facts.limits;
        Self {
            adapter: AdapterStatistics::of(&facts.info),
            kind: kind(facts.info.device_type).to_owned(),
            timestamps: facts.timestamps,
            limits: Limits {
                storage_buffers_per_stage: limits.max_storage_buffers_per_shader_stage,
                storage_binding_bytes: limits.max_storage_buffer_binding_size,
                buffer_bytes: limits.max_buffer_size,
                workgroup_memory_bytes: limits.max_compute_workgroup_storage_size,
                workgroup_invocations: limits.max_compute_invocations_per_workgroup,
                workgroups_per_dimension: limits.max_compute_workgroups_per_dimension,
                texture_side: limits.max_texture_dimension_2d,
            },
        }
    }
}

/// Runs `glimpse devices`.
pub fn run(options: &DevicesOptions, adapter: Option<&str>) -> anyhow::Result<()> {
    let facts = Gpu::adapters();
    let devices: Vec<Device> =
        facts.iter().filter(|f| named(&f.info.name, adapter)).map(Device::from).collect();
    if devices.is_empty() {
        let reason = match adapter {
            Some(name) => {
                let there: Vec<_> = facts.iter().map(|f| f.info.name.as_str()).collect();
                format!("none is named `{name}`; there is {}", output::listed(&there))
            }
            None => "expected a Vulkan driver; `sh desktop/setup.sh` installs one".to_owned(),
        };
        return Err(glimpse::Error::NoAdapter(reason).into());
    }
    if options.json {
        return output::print(&output::json(&devices)?);
    }
    output::print(&devices.iter().map(described).collect::<Vec<_>>().join("\n"))
}

fn named(name: &str, wanted: Option<&str>) -> bool {
    wanted.is_none_or(|wanted| name.to_lowercase().contains(&wanted.to_lowercase()))
}

fn kind(kind: wgpu::DeviceType) -> &'static str {
    match kind {
        wgpu::DeviceType::DiscreteGpu => "discrete GPU",
        wgpu::DeviceType::IntegratedGpu => "integrated GPU",
        wgpu::DeviceType::VirtualGpu => "virtual GPU",
        wgpu::DeviceType::Cpu => "CPU",
        wgpu::DeviceType::Other => "unknown",
    }
}

fn described(device: &Device) -> String {
    let l = &device.limits;
    let timing = if device.timestamps { "timestamps on the GPU" } else { "no timestamps: the CPU's clock" };
    [
        row("adapter", &device.adapter.name),
        row("kind", &device.kind),
        row("backend", &device.adapter.backend),
        row("driver", &device.adapter.driver),
        row("timing", timing),
        row(
            "storage",
            &format!(
                "{} buffers a workbench, {} a binding, {} a buffer",
                l.storage_buffers_per_stage,
                bytes(l.storage_binding_bytes),
                bytes(l.buffer_bytes)
            ),
        ),
        row(
            "compute",
            &format!(
                "{} invocations and {} memory a workgroup, {} workgroups a dimension",
                grouped(l.workgroup_invocations.into()),
                bytes(l.workgroup_memory_bytes.into()),
                grouped(l.workgroups_per_dimension.into())
            ),
        ),
        row("textures", &format!("{} texels a side", grouped(l.texture_side.into()))),
    ]
    .concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts() -> AdapterFacts {
        AdapterFacts {
            info: wgpu::AdapterInfo::new(wgpu::DeviceType::Cpu, wgpu::Backend::Vulkan),
            limits: wgpu::Limits::default(),
            timestamps: true,
        }
    }

    #[test]
    fn limits_arrive_in_text_and_json() {
        let device = Device::from(&facts());
        let text = described(&device);
        for expected in
            ["8 buffers a workbench, 128.0 MiB a binding", "256 invocations", "timestamps on the GPU"]
        {
            assert!(text.contains(expected), "no `{expected}` in\n{text}");
        }
        let json = serde_json::to_value(&device).unwrap();
        assert_eq!(json["limits"]["storage_binding_bytes"], 128 << 20);
        assert_eq!(json["backend"], "vulkan");
        assert_eq!(json["timestamps"], true);
    }

    #[test]
    fn names_match_in_any_case() {
        assert!(named("llvmpipe (LLVM 15)", Some("LLVMpipe")));
        assert!(!named("llvmpipe", Some("nvidia")));
        assert!(named("anything", None));
    }
}

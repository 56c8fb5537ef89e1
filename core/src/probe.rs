//! Rays of the caller's through the GPU's own traversal: what tests and measurements of it need.

use crate::{
    Gpu, GpuScene, Linking, Result,
    gpu::{Kernel, Timer, mirror::gpu_struct, shader::Source},
    passes::{TRACE_GROUP, TRACE_ROW, Variant},
};

gpu_struct! {
    /// A ray; `direction` need not have unit length.
    pub struct ProbeRay {
        /// World space.
        origin: [f32; 3],
        /// Hits at this parameter or beyond do not count.
        t_max: f32,
        /// World space.
        direction: [f32; 3],
        /// Not 0: any hit will do (a shadow ray).
        any: u32,
    }
}

gpu_struct! {
    /// What a ray meets.
    pub struct ProbeHit {
        /// In units of the ray's direction.
        t: f32,
        /// In the order of the leaves; [`ProbeHit::MISS`] without a hit.
        primitive: u32,
        /// OID, 0 without a hit.
        object: u32,
        /// Weight of the triangle's second corner.
        u: f32,
        /// Weight of the triangle's third corner.
        v: f32,
    }
}

impl ProbeHit {
    /// `primitive` of a ray that meets nothing.
    pub const MISS: u32 = u32::MAX;
}

/// Traces rays and returns their hits with the GPU time in milliseconds (0 without timestamps).
///
/// # Errors
/// A device that failed or cannot hold the rays.
pub fn trace_rays(gpu: &Gpu, scene: &GpuScene, rays: &[ProbeRay]) -> Result<(Vec<ProbeHit>, f64)> {
    let variant = Variant::new(scene, Linking::Auto, 1);
    let kernel = Kernel::new(gpu, "probe", &sources(&variant))?;
    let rays_buffer = gpu.storage("rays", rays)?;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let hits_buffer =
        gpu.buffer("hits", size_of_val(rays) as u64 / 32 * size_of::<ProbeHit>() as u64, usage)?;
    let mut resources = scene.resources();
    resources.extend([("rays", rays_buffer.as_entire_binding()), ("hits", hits_buffer.as_entire_binding())]);
    let bound = kernel.bind(&gpu.device, &resources)?;
    let timer = Timer::new(gpu, &["probe"])?;
    let groups = (rays.len() as u32).div_ceil(TRACE_GROUP);
    let mut ms = 0.0;
    // The first run compiles.
    for _ in 0..2 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        bound.dispatch(&mut timer.pass(&mut encoder, 0), [groups.min(TRACE_ROW), groups.div_ceil(TRACE_ROW)]);
        timer.resolve(&mut encoder);
        gpu.submit_and_wait(encoder)?;
        ms = timer.read(gpu)?.ms;
    }
    let bytes = gpu.read_buffer(&hits_buffer)?;
    let mut hits: Vec<ProbeHit> = bytemuck::pod_collect_to_vec(&bytes[..rays.len() * size_of::<ProbeHit>()]);
    hits.truncate(rays.len());
    Ok((hits, ms))
}

/// What the probe's kernel is made of.
pub(crate) fn sources(variant: &Variant) -> Vec<Source> {
    let entry = Source { file: "wgsl/probe.wgsl", text: include_str!("wgsl/probe.wgsl").into() };
    variant.tracing_sources([entry])
}

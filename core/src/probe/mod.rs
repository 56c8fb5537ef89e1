//! Runs the shaders' own functions on rays of the caller, for tests, stress cases and measurements.

mod fresnel;
mod peak;
mod ray;

#[cfg(test)]
pub(crate) use fresnel::fresnel_sources;
pub use fresnel::{ProbeBoundary, ProbeFresnel, fresnel};
pub use peak::peak_gflops;
pub use ray::ProbeRay;

use crate::{
    Camera, Gpu, GpuScene, Result, Robustness, SAMPLES_PER_SUBMISSION, Settings,
    device::{Kernel, Timer, mirror::gpu_struct, shader::Source},
    frame::recorder::FrameUniform,
    passes::{FrameSpec, TRACE_GROUP, TRACE_ROW, Tracing, wgsl},
};

gpu_struct! {
    /// The closest hit of a ray.
    pub struct ProbeHit {
        /// In units of the ray's direction; the ray's own end where it meets nothing.
        t: f32,
        /// In the order of the leaves; [`ProbeHit::MISS`] without a hit.
        primitive: u32,
        /// 1 + OID, 0 without a hit.
        object: u32,
        /// Weight of the triangle's second corner.
        u: f32,
        /// Weight of the triangle's third corner.
        v: f32,
    }
}

gpu_struct! {
    /// Where a ray arrives, and where rays that leave the surface start.
    pub struct ProbeSpawn {
        /// Position in world space.
        position: [f32; 3],
        /// In the order of the leaves; [`ProbeHit::MISS`] without a hit, with zeros in everything else.
        primitive: u32,
        /// Unit shading normal on the viewer's side.
        normal: [f32; 3],
        /// OID of the object.
        object: u32,
        /// Unit normal of the face on the viewer's side.
        face: [f32; 3],
        /// 1 where the ray comes from behind the surface.
        inside: u32,
        /// Where rays to the viewer's side of the face start.
        above: [f32; 3],
        /// Ray parameter of the hit, in units of the ray's direction.
        t: f32,
        /// Where rays to the other side of the face start.
        below: [f32; 3],
        /// Distance of `above` and `below` from the face, in world units.
        offset: f32,
    }
}

gpu_struct! {
    /// The radiance of a ray and the attributes of its first hit.
    pub struct ProbeSample {
        /// Linear RGB radiance.
        color: [f32; 3],
        /// Ray parameter of the first hit.
        depth: f32,
        /// Unit shading normal of the first hit.
        normal: [f32; 3],
        /// OID + 1, 0 where the ray meets nothing.
        object: u32,
        /// The part of the radiance that other rays brought.
        gcol: [f32; 3],
        /// Bit i is set where light i does not reach the first hit.
        shadow: u32,
        /// Texture coordinates, wrapped into [0, 1].
        texcoord: [f32; 2],
        /// Padding to the struct's alignment.
        padding0: u32,
        /// Padding to the struct's alignment.
        padding1: u32,
    }
}

impl ProbeHit {
    /// `primitive` of a ray that meets nothing.
    pub const MISS: u32 = u32::MAX;
}

/// Runs the shaders' functions on single rays against a scene.
pub struct Probe<'a> {
    gpu: &'a Gpu,
    scene: &'a GpuScene,
    spec: FrameSpec,
}

impl<'a> Probe<'a> {
    /// A probe with these measures against rounding.
    #[must_use]
    pub fn new(gpu: &'a Gpu, scene: &'a GpuScene, robustness: Robustness) -> Self {
        let spec =
            FrameSpec { robustness, ..FrameSpec::new(scene, &Settings { depth: 1, ..Settings::default() }) };
        Self { gpu, scene, spec }
    }

    /// The nearest hits (some hit where the ray asks for any), and the GPU time in milliseconds (0 without timestamps).
    ///
    /// # Errors
    /// A device that failed or cannot hold the rays.
    pub fn trace(&self, rays: &[ProbeRay]) -> Result<(Vec<ProbeHit>, f64)> {
        self.run("probe_trace", &trace_sources(&self.spec), rays, |hit: &mut ProbeHit, scale| {
            hit.t = scaled(hit.t, scale);
        })
    }

    /// How many surfaces each ray passes through before its end.
    ///
    /// # Errors
    /// A device that failed or cannot hold the rays.
    pub fn count(&self, rays: &[ProbeRay]) -> Result<Vec<u32>> {
        Ok(self.run("probe_count", &count_sources(&self.spec), rays, |_: &mut u32, _| {})?.0)
    }

    /// Where rays arrive, and where those that leave the surface start.
    ///
    /// # Errors
    /// A device that failed or cannot hold the rays.
    pub fn spawn(&self, rays: &[ProbeRay]) -> Result<Vec<ProbeSpawn>> {
        let rescale = |spawn: &mut ProbeSpawn, scale| spawn.t = scaled(spawn.t, scale);
        Ok(self.run("probe_spawn", &spawn_sources(&self.spec), rays, rescale)?.0)
    }

    /// Traces and shades rays, with the settings' recursion limits.
    ///
    /// # Errors
    /// Invalid settings, or a device that failed or cannot hold the rays.
    pub fn shade(&self, rays: &[ProbeRay], settings: &Settings) -> Result<Vec<ProbeSample>> {
        settings.validate()?;
        let settings_of_kernel = Settings { depth: settings.depth, ..self.spec.settings };
        let spec = FrameSpec { settings: settings_of_kernel, ..self.spec };
        let camera = Camera::framing(self.scene.bounds().0, self.scene.bounds().1);
        // Any ray may start inside of a solid.
        let eye_in_solid = u32::from(self.scene.nests_media());
        let frame = FrameUniform { eye_in_solid, ..FrameUniform::new(self.scene, settings, [1, 1], &camera) };
        let frame = self.gpu.filled("frame", bytemuck::bytes_of(&frame), wgpu::BufferUsages::UNIFORM)?;
        let more = [("frame", frame.as_entire_binding())];
        let rescale = |sample: &mut ProbeSample, scale| {
            if sample.object != 0 {
                sample.depth = scaled(sample.depth, scale);
            }
        };
        Ok(self.run_with("probe_shade", &shade_sources(&spec), rays, rescale, more)?.0)
    }

    fn run<O: bytemuck::Pod>(
        &self,
        label: &'static str,
        sources: &[Source],
        rays: &[ProbeRay],
        rescale: impl Fn(&mut O, f64),
    ) -> Result<(Vec<O>, f64)> {
        self.run_with(label, sources, rays, rescale, [])
    }

    /// `rescale` multiplies what is in units of the ray's direction.
    fn run_with<'r, O: bytemuck::Pod>(
        &'r self,
        label: &'static str,
        sources: &[Source],
        rays: &[ProbeRay],
        rescale: impl Fn(&mut O, f64),
        more: impl IntoIterator<Item = (&'static str, wgpu::BindingResource<'r>)>,
    ) -> Result<(Vec<O>, f64)> {
        let mut resources = self.scene.resources(self.gpu, self.spec.reads_lobe_albedos())?;
        resources.extend(more);
        let (sane, scales): (Vec<_>, Vec<_>) = rays.iter().map(ray::sane).unzip();
        let (mut results, ms) = dispatch(self.gpu, label, sources, &sane, &resources)?;
        results.iter_mut().zip(scales).for_each(|(result, scale)| rescale(result, scale));
        Ok((results, ms))
    }
}

/// Infinite where the parameter of a very short direction is beyond f32.
fn scaled(t: f32, scale: f64) -> f32 {
    (f64::from(t) * scale) as f32
}

/// Runs a kernel with one thread for each of `rays`, which writes one of `results`.
pub(crate) fn dispatch<I: bytemuck::NoUninit, O: bytemuck::Pod>(
    gpu: &Gpu,
    label: &'static str,
    sources: &[Source],
    inputs: &[I],
    resources: &[(&'static str, wgpu::BindingResource<'_>)],
) -> Result<(Vec<O>, f64)> {
    let kernel = Kernel::new(gpu, label, sources)?;
    let timer = Timer::new(gpu, vec![(label, Tracing::Listed)])?;
    let (mut all, mut ms) = (Vec::with_capacity(inputs.len()), 0.0);
    for inputs in inputs.chunks(SAMPLES_PER_SUBMISSION as usize) {
        let rays = gpu.storage("rays", inputs)?;
        let bytes = inputs.len() * size_of::<O>();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let results = gpu.buffer("results", bytes as u64, usage)?;
        let mut resources = resources.to_vec();
        resources.extend([("rays", rays.as_entire_binding()), ("results", results.as_entire_binding())]);
        let bound = kernel.bind(&gpu.device, &resources)?;
        let groups = (inputs.len() as u32).div_ceil(TRACE_GROUP);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        bound.dispatch(&mut timer.pass(&mut encoder, 0), [groups.min(TRACE_ROW), groups.div_ceil(TRACE_ROW)]);
        timer.resolve(&mut encoder);
        gpu.submit_and_wait(encoder)?;
        ms += timer.read(gpu)?.ms;
        all.extend(bytemuck::pod_collect_to_vec::<u8, O>(&gpu.read_buffer(&results)?[..bytes]));
    }
    Ok((all, ms))
}

/// The sources of the probe's tracing kernel.
pub(crate) fn trace_sources(spec: &FrameSpec) -> Vec<Source> {
    spec.tracing_sources([wgsl!("wgsl/probe/probe_ray.wgsl"), wgsl!("wgsl/probe/probe_trace.wgsl")])
}

pub(crate) fn count_sources(spec: &FrameSpec) -> Vec<Source> {
    let entry = [wgsl!("wgsl/probe/probe_ray.wgsl"), wgsl!("wgsl/probe/probe_count.wgsl")];
    spec.tracing_sources_with(wgsl!("wgsl/probe/any_hit_count.wgsl"), entry)
}

pub(crate) fn spawn_sources(spec: &FrameSpec) -> Vec<Source> {
    spec.tracing_sources([wgsl!("wgsl/probe/probe_ray.wgsl"), wgsl!("wgsl/probe/probe_spawn.wgsl")])
}

pub(crate) fn shade_sources(spec: &FrameSpec) -> Vec<Source> {
    spec.tracing_sources([wgsl!("wgsl/probe/probe_ray.wgsl"), wgsl!("wgsl/probe/probe_shade.wgsl")])
}

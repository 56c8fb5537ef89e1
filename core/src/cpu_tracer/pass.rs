//! Planes into the samples of a frame.

use crate::{
    Gpu, Result,
    device::{Bound, Kernels},
    frame::recorder::FrameUniform,
    frame::targets::Targets,
    passes::{FrameSpec, Output, path},
};

/// Side of a workgroup's tile in pixels.
const TILE: u32 = 16;

/// Runs between frames. It reads and writes two buffers of a frame once, neither larger than a binding: on a phone 128 MiB
/// each, which are there in less than a tenth of a second.
pub struct AccumulatePass {
    bound: Bound,
    frame: wgpu::Buffer,
    cpu_samples: wgpu::Buffer,
    groups: [u32; 2],
}

impl AccumulatePass {
    /// Links, compiles and binds. `color` is where means go.
    ///
    /// # Errors
    /// A device that cannot.
    pub fn new(
        gpu: &Gpu,
        targets: &Targets,
        spec: &FrameSpec,
        kernels: &mut Kernels,
        color: &wgpu::Texture,
    ) -> Result<Self> {
        let stage = &path::ACCUMULATE;
        let frame = gpu.buffer("frame", size_of::<FrameUniform>() as u64, wgpu::BufferUsages::UNIFORM)?;
        let [width, height] = targets.size.map(u64::from);
        let cpu_samples = gpu.buffer(
            "cpu_samples",
            width * height * size_of::<[f32; 3]>() as u64,
            wgpu::BufferUsages::STORAGE,
        )?;
        let view = color.create_view(&wgpu::TextureViewDescriptor::default());
        let output = if spec.output == Output::Linear { "linear" } else { "display" };
        let bound = kernels.get(gpu, stage.name, spec.sources(stage))?.bind(
            &gpu.device,
            &[
                ("frame", frame.as_entire_binding()),
                ("samples", targets.samples.as_entire_binding()),
                ("cpu_samples", cpu_samples.as_entire_binding()),
                (output, wgpu::BindingResource::TextureView(&view)),
            ],
        )?;
        let groups = targets.size.map(|side| side.div_ceil(TILE));
        Ok(Self { bound, frame, cpu_samples, groups })
    }

    /// Adds these sums, whose samples the constants count among the merged ones, and shows the means.
    ///
    /// # Errors
    /// A device that failed.
    pub fn run(&self, gpu: &Gpu, constants: &FrameUniform, rgb: &[f32]) -> Result<()> {
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(constants));
        gpu.queue.write_buffer(&self.cpu_samples, 0, bytemuck::cast_slice(rgb));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.bound.dispatch(&mut encoder.begin_compute_pass(&Default::default()), self.groups);
        gpu.submit_and_wait(encoder)
    }
}

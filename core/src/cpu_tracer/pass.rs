//! The GPU pass that adds planes of CPU samples to the sums of a frame.

use crate::{
    Gpu, Result,
    device::{Bound, Kernels},
    frame::recorder::FrameUniform,
    frame::targets::Targets,
    passes::{FrameSpec, Output, path},
};

/// Side of a workgroup's tile in pixels.
const TILE: u32 = 16;

/// Adds CPU samples between frames. It reads and writes two buffers of a frame once, neither larger than a
/// binding (128 MiB on phones), which takes less than a tenth of a second there.
pub struct AccumulatePass {
    bound: Bound,
    frame: wgpu::Buffer,
    cpu_samples: wgpu::Buffer,
    groups: [u32; 2],
}

impl AccumulatePass {
    /// Links, compiles and binds the kernel. `color` is the image that it writes the means to.
    ///
    /// # Errors
    /// The kernel does not compile, or the device cannot hold its buffers.
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

    /// Adds the sums `rgb` and writes the means; the constants already count their samples as merged.
    ///
    /// # Errors
    /// The device failed.
    pub fn run(&self, gpu: &Gpu, constants: &FrameUniform, rgb: &[f32]) -> Result<()> {
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(constants));
        gpu.queue.write_buffer(&self.cpu_samples, 0, bytemuck::cast_slice(rgb));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.bound.dispatch(&mut encoder.begin_compute_pass(&Default::default()), self.groups);
        gpu.submit_and_wait(encoder)
    }
}

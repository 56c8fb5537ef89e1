//! The buffers and images of a frame.

use crate::{
    Error, Gpu, GpuScene, Memory, Method, Result,
    frame::{FRAME_STRIDE, Frame, PixelRecord},
    passes::{COUNTER_WORDS, Variant},
    plan::Plan,
};

/// A listed pixel is one word: 16 bits a coordinate.
const MAX_SIDE: u32 = 1 << 16;

/// Bytes of the arguments of an indirect dispatch.
pub const DISPATCH_BYTES: u64 = 12;

/// The buffers and images of one frame size.
pub struct Targets {
    pub size: [u32; 2],
    pub plan: Plan,
    pub frame: wgpu::Buffer,
    pub attributes: wgpu::Buffer,
    pub list: wgpu::Buffer,
    pub dispatch: wgpu::Buffer,
    pub display: wgpu::Texture,
}

impl Targets {
    /// Makes them, as far as the method needs them.
    ///
    /// # Errors
    /// A size that is not a frame's, or a device that cannot hold it.
    pub fn new(gpu: &Gpu, variant: &Variant, method: Method, size: [u32; 2]) -> Result<Self> {
        let [width, height] = size.map(u64::from);
        let limit = gpu.limits().max_texture_dimension_2d.min(MAX_SIDE);
        if size.iter().any(|side| !(1..=limit).contains(side)) {
            return Err(Error::setting(
                format!("--size {width}x{height}"),
                format!("expected 1 to {limit} pixels a side"),
            ));
        }
        let adaptive = method == Method::Adaptive;
        let planes = variant.planes().len() as u64;
        let attributes = if adaptive { 4 * planes * width * height.div_ceil(2) } else { 0 };
        let plan = Plan::new(method, size);
        let list = if adaptive { 4 * (2 + u64::from(plan.longest_list)) } else { 0 };
        let frames = FRAME_STRIDE * plan.parts.len() as u64;
        let dispatches = DISPATCH_BYTES * u64::from(plan.chunks());
        let storage = wgpu::BufferUsages::STORAGE;
        Ok(Self {
            size,
            plan,
            frame: gpu.buffer("frame", frames, wgpu::BufferUsages::UNIFORM)?,
            attributes: gpu.buffer("attributes", attributes, storage)?,
            list: gpu.buffer("list", list, storage)?,
            dispatch: gpu.buffer("dispatch", dispatches, storage | wgpu::BufferUsages::INDIRECT)?,
            display: texture(gpu, "display", size, wgpu::TextureFormat::Rgba8Unorm)?,
        })
    }

    /// The constants of the plan's part of that index.
    pub fn constants(&self, part: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.frame,
            offset: FRAME_STRIDE * part as u64,
            size: wgpu::BufferSize::new(size_of::<Frame>() as u64),
        })
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        let buffers = [&self.frame, &self.attributes, &self.list, &self.dispatch];
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        buffers.iter().map(|b| b.size()).sum::<u64>() + 4 * pixels
    }

    /// Bytes on the device together with the scene's.
    pub fn memory(&self, scene: &GpuScene) -> Memory {
        let (scene, bvh) = scene.bytes();
        let targets = self.bytes();
        Memory { scene, bvh, targets, total: scene + bvh + targets }
    }
}

/// A storage texture that can be read back.
///
/// # Errors
/// A device that cannot hold it, or no buffer to read it back into.
pub fn texture(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> Result<wgpu::Texture> {
    let bytes = gpu.check_readback(label, size, format)?;
    gpu.checked(&format!("image `{label}`"), Some(bytes), |device| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::STORAGE_BINDING
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    })
}

/// What the counting kernels write into: counters, then a record a pixel.
pub fn inspection_buffer(gpu: &Gpu, size: [u32; 2]) -> Result<wgpu::Buffer> {
    let records = u64::from(size[0]) * u64::from(size[1]) * size_of::<PixelRecord>() as u64;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    gpu.buffer("inspection", 4 * COUNTER_WORDS as u64 + records, usage)
}

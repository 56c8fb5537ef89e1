//! The buffers and images of a frame.

use crate::{
    Denoise, Error, Gpu, GpuScene, Memory, Method, Result,
    frame::counters::COUNTER_WORDS,
    frame::plan::{self, Plan},
    frame::recorder::{FRAME_STRIDE, FrameUniform, PixelRecord},
    passes::{FrameSpec, REFINE_MOST, REFINE_STEP, REFINE_WORDS, Recipe},
};

/// A listed pixel is one word: 16 bits a coordinate.
const MAX_SIDE: u32 = 1 << 16;

/// An active quarter of a pixel is one word too: 14 bits a coordinate.
const MAX_SUPERSAMPLED_SIDE: u32 = 1 << 14;

/// Bytes of the arguments of an indirect dispatch.
pub const DISPATCH_BYTES: u64 = 12;

/// Bytes of the list before its first pixel.
pub const LIST_HEADER: u64 = 16;

/// Bytes of a sample's radiance.
const SAMPLE_BYTES: u64 = 12;

/// And of one that may cross over to the other eye: also what lands in its pixel.
const STEREO_SAMPLE_BYTES: u64 = 36;

/// A bit for each sample of a quincunx that a pixel may share with others.
const CLAIM_BYTES: u64 = 4;

/// Bytes that a frame leaves of a pixel: a point and its radiance.
const HISTORY_BYTES: u64 = 24;

/// Bytes of what landed in a pixel: a key and where it came from.
const SPLAT_BYTES: u64 = 8;

/// Bytes of what a path's first diffuse surface is.
const GBUFFER_BYTES: u64 = 16;

/// Bytes of a pixel as the a-trous filter sees it.
const ATROUS_BUFFER_BYTES: u64 = 16;

/// No buffer of a band is larger: half of what WebGPU lets a storage binding be.
const BAND_BYTES: u64 = 64 << 20;

/// The buffers and images of one frame size.
pub struct Targets {
    /// Pixels.
    pub size: [u32; 2],
    /// Samples.
    pub grid: [u32; 2],
    pub plan: Plan,
    pub frame: wgpu::Buffer,
    pub attributes: wgpu::Buffer,
    pub list: wgpu::Buffer,
    pub samples: wgpu::Buffer,
    pub dispatch: wgpu::Buffer,
    pub display: wgpu::Texture,
    /// What a frame leaves for the next one, in turn.
    pub histories: [wgpu::Buffer; 2],
    /// Where that is seen from the next camera.
    pub splats: wgpu::Buffer,
    /// What guides the removal of noise.
    pub gbuffer: wgpu::Buffer,
    /// What is filtered, from one level to the next in turn.
    pub atrous_buffers: [wgpu::Buffer; 2],
}

impl Targets {
    /// Makes them, as far as the method needs them.
    ///
    /// # Errors
    /// A size that is not a frame's, or a device that cannot hold it.
    pub fn new(gpu: &Gpu, spec: &FrameSpec, size: [u32; 2]) -> Result<Self> {
        let settings = &spec.settings;
        let grid = grid(gpu, size, settings.sampling)?;
        if (settings.supersamples() || settings.method == Method::Quincunx)
            && size.iter().any(|side| *side > MAX_SUPERSAMPLED_SIDE)
        {
            let expected = format!("at most {MAX_SUPERSAMPLED_SIDE} pixels a side with extra samples");
            return Err(Error::setting("size", expected, format!("{}x{}", size[0], size[1])));
        }
        // Of two rows.
        let quincunx = settings.method == Method::Quincunx;
        let attribute_bytes = if quincunx { 2 * CLAIM_BYTES } else { 4 * u64::from(spec.stored_channels()) };
        let of_method = Recipe::of(settings.method).storage;
        let stored = of_method.radiances.max(u64::from(settings.sampling > 1));
        let sample_bytes = stored * if settings.reuses_stereo() { STEREO_SAMPLE_BYTES } else { SAMPLE_BYTES };
        // A sample is listed once at most, or its quarters are.
        let listed = match (settings.refines(), settings.supersamples()) {
            // An entry for each step, and what is known of the pixel.
            (true, _) => u64::from(REFINE_MOST / REFINE_STEP + REFINE_WORDS),
            (false, true) => 4,
            (false, false) => of_method.listed,
        };
        let list_bytes = 4 * listed;
        let row_bytes = u64::from(grid[0]) * sample_bytes.max(attribute_bytes.div_ceil(2)).max(list_bytes);
        let band = plan::band_rows(settings.sampling, BAND_BYTES / row_bytes.max(1));
        let plan = Plan::new(spec, grid, of_method.band_rows.map_or(u32::MAX, |most| band.min(most)));
        // The corners of a pixel are beside and below it.
        let border = u64::from(quincunx);
        let rows = u64::from(plan.stored_rows) + border;
        let width = u64::from(grid[0]) + border;
        let storage = wgpu::BufferUsages::STORAGE;
        let moved = if settings.method == Method::Reproject { width * rows } else { 0 };
        let history = || gpu.buffer("history", HISTORY_BYTES * moved, storage);
        let denoise = settings.denoise();
        let gbuffer_pixels = if denoise == Denoise::Off { 0 } else { width * rows };
        let atrous_pixels = if denoise == Denoise::Atrous { width * rows } else { 0 };
        let atrous_buffers = || gpu.buffer("atrous_buffer", ATROUS_BUFFER_BYTES * atrous_pixels, storage);
        let dispatches = DISPATCH_BYTES * u64::from(plan.chunks());
        Ok(Self {
            size,
            grid,
            frame: gpu.buffer(
                "frame",
                FRAME_STRIDE * plan.parts.len() as u64,
                wgpu::BufferUsages::UNIFORM,
            )?,
            attributes: gpu.buffer("attributes", attribute_bytes * width * rows.div_ceil(2), storage)?,
            list: gpu.buffer("list", LIST_HEADER + list_bytes * width * rows, storage)?,
            samples: gpu.buffer("samples", sample_bytes * width * rows, storage)?,
            gbuffer: gpu.buffer(
                "gbuffer",
                GBUFFER_BYTES * gbuffer_pixels,
                storage | wgpu::BufferUsages::COPY_SRC,
            )?,
            atrous_buffers: [atrous_buffers()?, atrous_buffers()?],
            dispatch: gpu.buffer("dispatch", dispatches, storage | wgpu::BufferUsages::INDIRECT)?,
            display: texture(gpu, "display", size, wgpu::TextureFormat::Rgba8Unorm)?,
            histories: [history()?, history()?],
            splats: gpu.buffer("splats", SPLAT_BYTES * moved, storage)?,
            plan,
        })
    }

    /// The constants of the plan's part of that index.
    pub fn constants(&self, part: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.frame,
            offset: FRAME_STRIDE * part as u64,
            size: wgpu::BufferSize::new(size_of::<FrameUniform>() as u64),
        })
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        let [history, history_before] = &self.histories;
        let [atrous_buffers, atrous_before] = &self.atrous_buffers;
        let kept = [history, history_before, &self.splats, &self.gbuffer, atrous_buffers, atrous_before];
        let buffers = [&self.frame, &self.attributes, &self.list, &self.samples, &self.dispatch];
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        buffers.iter().chain(&kept).map(|b| b.size()).sum::<u64>() + 4 * pixels
    }

    /// Bytes on the device together with the scene's.
    pub fn memory(&self, scene: &GpuScene) -> Memory {
        let (scene, bvh) = scene.bytes();
        let targets = self.bytes();
        Memory { scene, bvh, targets, total: scene + bvh + targets }
    }
}

/// The samples of a frame of that size.
fn grid(gpu: &Gpu, size: [u32; 2], sampling: u32) -> Result<[u32; 2]> {
    let [width, height] = size;
    let limit = gpu.limits().max_texture_dimension_2d;
    let grid = size.map(|side| side.saturating_mul(sampling));
    if size.iter().any(|side| !(1..=limit).contains(side)) {
        let expected = format!("1 to {limit} pixels a side");
        return Err(Error::setting("size", expected, format!("{width}x{height}")));
    }
    if grid.iter().any(|side| *side > MAX_SIDE) {
        let expected = format!("at most {MAX_SIDE} samples a side of {width}x{height} pixels");
        return Err(Error::setting("sampling", expected, sampling.to_string()));
    }
    Ok(grid)
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

/// What the counting kernels write into: counters, then that many records.
pub fn inspection_buffer(gpu: &Gpu, records: u64) -> Result<wgpu::Buffer> {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    gpu.buffer("inspection", inspection_bytes(records), usage)
}

/// Can one binding hold the counters and that many records?
pub fn inspection_fits(gpu: &Gpu, records: u64) -> bool {
    gpu.check_binding("inspection", inspection_bytes(records)).is_ok()
}

fn inspection_bytes(records: u64) -> u64 {
    4 * COUNTER_WORDS as u64 + records.max(1) * size_of::<PixelRecord>() as u64
}

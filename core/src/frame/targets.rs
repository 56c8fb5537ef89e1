//! The buffers and images that the passes of a frame write.

use crate::{
    Denoise, Error, Gpu, GpuScene, Memory, Method, Result,
    frame::counters::COUNTER_WORDS,
    frame::plan::{self, Plan},
    frame::recorder::{FRAME_STRIDE, FrameUniform, PixelRecord},
    passes::{FrameSpec, REFINE_MOST, REFINE_STEP, REFINE_WORDS, Recipe},
};

/// Largest side of a frame in samples: a list entry packs both coordinates into 16 bits each.
const MAX_SIDE: u32 = 1 << 16;

/// Largest side in pixels with extra samples: an entry packs a subpixel and both coordinates into 14 bits each.
const MAX_SUPERSAMPLED_SIDE: u32 = 1 << 14;

/// Size in bytes of the arguments of an indirect dispatch.
pub const DISPATCH_BYTES: u64 = 12;

/// Size in bytes of the list's header, before its first entry.
pub const LIST_HEADER: u64 = 16;

/// Bytes of a stored sample: its RGB radiance.
const SAMPLE_BYTES: u64 = 12;

/// Bytes of a sample with stereo reuse: its radiance and what the other eye contributes (`samples_stereo.wgsl`).
const STEREO_SAMPLE_BYTES: u64 = 36;

/// Bytes of a pixel's claims in a quincunx: a bit for each sample that it may share with other pixels.
const CLAIM_BYTES: u64 = 4;

/// Bytes of a pixel in the history: the position and the radiance of its point.
const HISTORY_BYTES: u64 = 24;

/// Bytes of a reprojected point in a pixel: a depth key and the pixel that it comes from.
const SPLAT_BYTES: u64 = 8;

/// Bytes of a pixel in the G-buffer.
const GBUFFER_BYTES: u64 = 16;

/// Bytes of a pixel in a buffer of the a-trous filter.
const ATROUS_BUFFER_BYTES: u64 = 16;

/// Largest size in bytes of a buffer that holds a band: half of WebGPU's default limit for storage bindings.
const BAND_BYTES: u64 = 64 << 20;

/// The buffers and images of one frame size.
pub struct Targets {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Samples across and down.
    pub grid: [u32; 2],
    pub plan: Plan,
    pub frame: wgpu::Buffer,
    pub attributes: wgpu::Buffer,
    pub list: wgpu::Buffer,
    pub samples: wgpu::Buffer,
    pub dispatch: wgpu::Buffer,
    pub display: wgpu::Texture,
    /// Points and radiances of the last two frames; frames alternate between them.
    pub histories: [wgpu::Buffer; 2],
    /// Depth keys and sources of the points reprojected into the current view.
    pub splats: wgpu::Buffer,
    /// Attributes of first diffuse surfaces, which guide the denoiser.
    pub gbuffer: wgpu::Buffer,
    /// The filtered light; levels of the a-trous filter alternate between the two.
    pub atrous_buffers: [wgpu::Buffer; 2],
}

impl Targets {
    /// Allocates the buffers and images; those that the method does not need are minimal.
    ///
    /// # Errors
    /// The size is not allowed, or the device cannot hold the buffers.
    pub fn new(gpu: &Gpu, spec: &FrameSpec, size: [u32; 2]) -> Result<Self> {
        let settings = &spec.settings;
        let grid = grid(gpu, size, settings.sampling)?;
        if (settings.supersamples() || settings.method == Method::Quincunx)
            && size.iter().any(|side| *side > MAX_SUPERSAMPLED_SIDE)
        {
            let expected = format!("at most {MAX_SUPERSAMPLED_SIDE} pixels a side with extra samples");
            return Err(Error::setting("size", expected, format!("{}x{}", size[0], size[1])));
        }
        // Bytes per column of two rows of samples.
        let quincunx = settings.method == Method::Quincunx;
        let attribute_bytes = if quincunx { 2 * CLAIM_BYTES } else { 4 * u64::from(spec.stored_channels()) };
        let of_method = Recipe::of(settings.method).storage;
        let stored = of_method.radiances.max(u64::from(settings.sampling > 1));
        let sample_bytes = stored * if settings.reuses_stereo() { STEREO_SAMPLE_BYTES } else { SAMPLE_BYTES };
        // Entries per sample in the list: the sample, or each of its subpixels.
        let listed = match (settings.refines(), settings.supersamples()) {
            // An entry for each step, and the state of the refined pixel.
            (true, _) => u64::from(REFINE_MOST / REFINE_STEP + REFINE_WORDS),
            (false, true) => 4,
            (false, false) => of_method.listed,
        };
        let list_bytes = 4 * listed;
        let row_bytes = u64::from(grid[0]) * sample_bytes.max(attribute_bytes.div_ceil(2)).max(list_bytes);
        let band = plan::band_rows(settings.sampling, BAND_BYTES / row_bytes.max(1));
        let plan = Plan::new(spec, grid, of_method.band_rows.map_or(u32::MAX, |most| band.min(most)));
        // A pixel's far corners belong to the next column and row.
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

    /// The uniform of the plan's part with index `part`.
    pub fn constants(&self, part: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.frame,
            offset: FRAME_STRIDE * part as u64,
            size: wgpu::BufferSize::new(size_of::<FrameUniform>() as u64),
        })
    }

    /// Size of all buffers and images in bytes.
    pub fn bytes(&self) -> u64 {
        let [history, history_before] = &self.histories;
        let [atrous_buffers, atrous_before] = &self.atrous_buffers;
        let kept = [history, history_before, &self.splats, &self.gbuffer, atrous_buffers, atrous_before];
        let buffers = [&self.frame, &self.attributes, &self.list, &self.samples, &self.dispatch];
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        buffers.iter().chain(&kept).map(|b| b.size()).sum::<u64>() + 4 * pixels
    }

    /// Bytes of these targets and of the scene.
    pub fn memory(&self, scene: &GpuScene) -> Memory {
        let (scene, bvh) = scene.bytes();
        let targets = self.bytes();
        Memory { scene, bvh, targets, total: scene + bvh + targets }
    }
}

/// The plan of frames of `size` pixels, as if any number of rows could be stored.
///
/// # Errors
/// The size is not allowed.
pub fn plan_of(gpu: &Gpu, spec: &FrameSpec, size: [u32; 2]) -> Result<Plan> {
    let rows = Recipe::of(spec.settings.method).storage.band_rows;
    Ok(Plan::new(spec, grid(gpu, size, spec.settings.sampling)?, rows.unwrap_or(u32::MAX)))
}

/// Samples across and down in a frame of `size` pixels with `sampling` x `sampling` samples each.
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

/// Creates a storage texture that can be read back.
///
/// # Errors
/// The device cannot hold the texture, or a buffer for reading it back.
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

/// Allocates the buffer that the counting kernels write: the counters, then `records` pixel records.
pub fn inspection_buffer(gpu: &Gpu, records: u64) -> Result<wgpu::Buffer> {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    gpu.buffer("inspection", inspection_bytes(records), usage)
}

/// Whether one binding can hold the counters and `records` pixel records.
pub fn inspection_fits(gpu: &Gpu, records: u64) -> bool {
    gpu.check_binding("inspection", inspection_bytes(records)).is_ok()
}

fn inspection_bytes(records: u64) -> u64 {
    4 * COUNTER_WORDS as u64 + records.max(1) * size_of::<PixelRecord>() as u64
}

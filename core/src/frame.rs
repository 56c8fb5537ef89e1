//! The frame: its passes in order, its constants, its targets.

use crate::{
    Camera, Error, Gpu, GpuScene, Memory, Method, Result, Settings,
    gpu::{Bound, Kernel, Timer, mirror::gpu_struct, shader::Source},
    passes::{COUNTER_WORDS, Output, Stage, Variant},
};

gpu_struct! {
    /// The constants of a frame.
    pub struct Frame {
        origin: [f32; 3], orthographic: f32,
        right: [f32; 3], min_weight: f32,
        up: [f32; 3], pos_tolerance: f32,
        forward: [f32; 3], norm_tolerance: f32,
        background: [f32; 3], tex_tolerance: f32,
        ambient: [f32; 3], gcol_tolerance: f32,
        truncated: [f32; 3], depth: u32,
        size: [u32; 2], inverse_height: f32, padding: u32,
    }
}

gpu_struct! {
    /// What the counting kernels write of a pixel.
    pub struct PixelRecord {
        origin: u32, failed: u32, cost: u32, object: u32, depth: f32, normal: u32,
    }
}

impl Frame {
    /// The constants of one frame of a scene.
    pub fn new(scene: &GpuScene, settings: &Settings, size: [u32; 2], camera: &Camera) -> Self {
        let environment = &scene.environment;
        Self {
            origin: camera.origin.into(),
            orthographic: if camera.orthographic { 1.0 } else { 0.0 },
            right: camera.right.into(),
            min_weight: settings.min_weight,
            up: camera.up.into(),
            pos_tolerance: settings.tolerances.pos * scene.longest_side(),
            forward: camera.forward.into(),
            norm_tolerance: settings.tolerances.norm,
            background: environment.background.into(),
            tex_tolerance: settings.tolerances.tex,
            ambient: environment.ambient.into(),
            gcol_tolerance: settings.tolerances.gcol,
            truncated: environment.truncated.into(),
            depth: settings.depth,
            size,
            inverse_height: 1.0 / size[1] as f32,
            padding: 0,
        }
    }
}

/// The buffers and images of one frame size.
pub struct Targets {
    pub size: [u32; 2],
    pub frame: wgpu::Buffer,
    pub attributes: wgpu::Buffer,
    pub list: wgpu::Buffer,
    pub dispatch: wgpu::Buffer,
    pub display: wgpu::Texture,
}

impl Targets {
    /// Makes them, as far as the method needs them.
    pub fn new(gpu: &Gpu, variant: &Variant, method: Method, size: [u32; 2]) -> Result<Self> {
        let [width, height] = size.map(u64::from);
        let limit = gpu.limits().max_texture_dimension_2d;
        if size.iter().any(|side| !(1..=limit).contains(side)) {
            return Err(Error::setting(
                format!("--size {width}x{height}"),
                format!("expected 1 to {limit} pixels a side"),
            ));
        }
        let adaptive = method == Method::Adaptive;
        let planes = variant.planes().len() as u64;
        let attributes = if adaptive { 4 * planes * width * height.div_ceil(2) } else { 0 };
        let list = if adaptive { 4 * (2 + width * height.div_ceil(2)) } else { 0 };
        let storage = wgpu::BufferUsages::STORAGE;
        Ok(Self {
            size,
            frame: gpu.buffer("frame", size_of::<Frame>() as u64, wgpu::BufferUsages::UNIFORM)?,
            attributes: gpu.buffer("attributes", attributes, storage)?,
            list: gpu.buffer("list", list, storage)?,
            dispatch: gpu.buffer("dispatch", 12, storage | wgpu::BufferUsages::INDIRECT)?,
            display: texture(gpu, "display", size, wgpu::TextureFormat::Rgba8Unorm)?,
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
pub fn texture(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> Result<wgpu::Texture> {
    gpu.checked(|device| {
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

/// The compiled passes of a method in one variant.
pub struct Passes {
    stages: Vec<Bound>,
    timer: Timer,
    method: Method,
}

impl Passes {
    /// Links, compiles and binds. `color` is where colours go, `inspection` where counting kernels write.
    pub fn new(
        gpu: &Gpu,
        scene: &GpuScene,
        targets: &Targets,
        variant: &Variant,
        method: Method,
        color: &wgpu::Texture,
        inspection: Option<&wgpu::Buffer>,
    ) -> Result<Self> {
        let stages: &[Stage] = match method {
            Method::Full => &Stage::FULL,
            Method::Adaptive => &Stage::ADAPTIVE,
        };
        let color = color.create_view(&wgpu::TextureViewDescriptor::default());
        let mut resources = scene.resources();
        resources.extend([
            ("frame", targets.frame.as_entire_binding()),
            ("attributes", targets.attributes.as_entire_binding()),
            ("list", targets.list.as_entire_binding()),
            ("dispatch", targets.dispatch.as_entire_binding()),
            match variant.output {
                Output::Display => ("display", wgpu::BindingResource::TextureView(&color)),
                Output::Linear => ("linear", wgpu::BindingResource::TextureView(&color)),
            },
        ]);
        resources.extend(inspection.map(|buffer| ("inspection", buffer.as_entire_binding())));
        // Two stages may be one kernel.
        let mut kernels: Vec<(Vec<Source>, Bound)> = Vec::new();
        let mut bound = Vec::new();
        for stage in stages {
            let sources = variant.sources(*stage);
            if let Some((_, same)) = kernels.iter().find(|(known, _)| *known == sources) {
                bound.push(same.clone());
                continue;
            }
            let kernel = Kernel::new(gpu, stage.name(), &sources)?.bind(&gpu.device, &resources)?;
            kernels.push((sources, kernel.clone()));
            bound.push(kernel);
        }
        let names: Vec<_> = stages.iter().map(|stage| stage.name()).collect();
        Ok(Self { stages: bound, timer: Timer::new(gpu, &names)?, method })
    }

    /// Records one frame.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        match self.method {
            Method::Full => self.full(encoder, targets),
            Method::Adaptive => self.adaptive(encoder, targets),
        }
        self.timer.resolve(encoder);
    }

    /// The timestamps of the frame that has just been waited for.
    pub fn times(&self, gpu: &Gpu) -> Result<crate::FrameTime> {
        self.timer.read(gpu)
    }

    fn full(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        let [width, height] = targets.size;
        // A ray through every pixel.
        self.direct(encoder, 0, [width.div_ceil(8), height.div_ceil(8)]);
    }

    fn adaptive(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        let [width, height] = targets.size;
        let (columns, rows) = (width.div_ceil(2), height.div_ceil(2));
        // A ray through every second pixel of every second row.
        self.direct(encoder, 0, [columns.div_ceil(8), rows.div_ceil(8)]);
        // The pixels between them in their rows: interpolate or list, then trace the listed.
        encoder.clear_buffer(&targets.list, 0, Some(4));
        self.direct(encoder, 1, [columns.div_ceil(16), rows.div_ceil(16)]);
        self.direct(encoder, 2, [1, 1]);
        self.indirect(encoder, 3, targets);
        // The rows between: the same, from the pixels above and below.
        encoder.clear_buffer(&targets.list, 0, Some(4));
        self.direct(encoder, 4, [width.div_ceil(16), rows.div_ceil(16)]);
        self.direct(encoder, 5, [1, 1]);
        self.indirect(encoder, 6, targets);
    }

    fn direct(&self, encoder: &mut wgpu::CommandEncoder, stage: usize, groups: [u32; 2]) {
        self.stages[stage].dispatch(&mut self.timer.pass(encoder, stage), groups);
    }

    fn indirect(&self, encoder: &mut wgpu::CommandEncoder, stage: usize, targets: &Targets) {
        self.stages[stage].dispatch_indirect(&mut self.timer.pass(encoder, stage), &targets.dispatch);
    }
}

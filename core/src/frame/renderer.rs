//! The renderer: renders frames of one scene with one size and one set of settings.

#[cfg(feature = "reference")]
mod accumulate;
mod commands;
mod target;

pub use commands::FrameCommands;

use crate::{
    Camera, Denoise, DisplayImage, Error, FrameTime, Gpu, GpuScene, Inspection, LinearImage, Memory, Method,
    Paths, Postcorrect, Result, Settings,
    device::{Compilation, Kernels},
    frame::inspection,
    frame::recorder::{FramePaths, FrameUniform, Passes},
    frame::sequence::{Sequence, Step},
    frame::targets::{self, Targets, inspection_buffer, inspection_fits, texture},
    passes::{FrameSpec, Output},
};

/// Ambient radiance of previews; the light at the eye adds up to 1 at surfaces that face it.
const PREVIEW_AMBIENT: f32 = 0.3;

/// What kernels are compiled for ([`Renderer::compilation`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// [`Renderer::preview`].
    Preview,
    /// Frames of [`Renderer::new`].
    Frame,
    /// [`Renderer::inspect`].
    Counters,
}

/// Renders frames of one scene at one size. It holds handles of the device and the scene, which live as long as
/// it does.
///
/// With a method that [keeps frames](Method::has_history), each frame continues the sequence of those before it.
/// A sequence starts by tracing every pixel: on the first frame and after a change of size or settings or
/// [`Renderer::linear_image`]. A frame that was given up is not part of the sequence.
pub struct Renderer {
    gpu: Gpu,
    scene: GpuScene,
    spec: FrameSpec,
    targets: Targets,
    kernels: Kernels,
    passes: Passes,
    sequence: Sequence,
    /// Whether the display image is the caller's ([`Renderer::set_target`]).
    has_target: bool,
    inspecting: Option<(Passes, wgpu::Buffer)>,
    linear: Option<(Passes, wgpu::Texture)>,
    #[cfg(feature = "reference")]
    accumulating: Option<crate::cpu_tracer::AccumulatePass>,
}

impl Renderer {
    /// Links and compiles the kernels and allocates the buffers and images.
    ///
    /// # Errors
    /// The settings or the size are invalid, or the device cannot hold or compile what they need.
    pub fn new(gpu: &Gpu, scene: &GpuScene, size: [u32; 2], settings: &Settings) -> Result<Self> {
        settings.validate()?;
        Self::of_spec(gpu, scene, size, FrameSpec::new(scene, &resolved(settings, scene, size)))
    }

    /// A renderer of previews, to show a scene while the kernels of others are compiled: base colours lit from the eye,
    /// by primary rays alone. Its single kernel is compiled in a fraction of the time of others.
    ///
    /// # Errors
    /// The errors of [`Renderer::new`].
    pub fn preview(gpu: &Gpu, scene: &GpuScene, size: [u32; 2]) -> Result<Self> {
        Self::of_spec(gpu, scene, size, FrameSpec::preview(scene))
    }

    fn of_spec(gpu: &Gpu, scene: &GpuScene, size: [u32; 2], spec: FrameSpec) -> Result<Self> {
        let targets = Targets::new(gpu, &spec, size)?;
        let mut kernels = Kernels::default();
        let passes = Passes::new(gpu, scene, &targets, &spec, &mut kernels, &targets.display, None)?;
        let sequence = Sequence::new(&spec.settings);
        Ok(Self {
            gpu: gpu.clone(),
            scene: scene.clone(),
            spec,
            targets,
            kernels,
            passes,
            sequence,
            has_target: false,
            inspecting: None,
            linear: None,
            #[cfg(feature = "reference")]
            accumulating: None,
        })
    }

    /// The kernels that such a renderer and its counters need and the device has not compiled: with
    /// [`Renderer::new`], [`Renderer::preview`] or [`Renderer::inspect`] alone the first frame waits for them.
    ///
    /// # Errors
    /// The settings or the size are invalid.
    pub fn compilation(
        gpu: &Gpu,
        scene: &GpuScene,
        size: [u32; 2],
        settings: &Settings,
        purpose: Purpose,
    ) -> Result<Compilation> {
        settings.validate()?;
        let spec = FrameSpec::new(scene, &resolved(settings, scene, size));
        let spec = match purpose {
            Purpose::Preview => FrameSpec::preview(scene),
            Purpose::Frame => spec,
            Purpose::Counters => FrameSpec {
                inspect: true,
                records: records(gpu, size, &spec.settings) > 0,
                output: shown(&spec.settings),
                ..spec
            },
        };
        let plan = targets::plan_of(gpu, &spec, size)?;
        let kernels = plan.passes().into_iter().map(|stage| (stage.name, spec.sources(stage)));
        Ok(Compilation::new(gpu, kernels.collect()))
    }

    /// Changes the size or the settings; compiled kernels are kept. After an error the renderer is unchanged.
    ///
    /// # Errors
    /// The errors of [`Renderer::new`].
    pub fn change(&mut self, size: [u32; 2], settings: &Settings) -> Result<()> {
        settings.validate()?;
        let spec = self.spec.changed(&self.scene, &resolved(settings, &self.scene, size));
        let settings = spec.settings;
        let Settings { tolerances, min_weight, .. } = settings;
        let gaze = settings.paths.gaze;
        // These settings are only uniform constants: nothing needs to be linked or allocated again.
        if size != self.targets.size
            || settings
                != (Settings {
                    tolerances,
                    min_weight,
                    paths: Paths { gaze, ..self.spec.settings.paths },
                    ..self.spec.settings
                })
        {
            let mut targets = Targets::new(&self.gpu, &spec, size)?;
            let has_target = self.has_target && size == self.targets.size;
            if has_target {
                targets.display = self.targets.display.clone();
            }
            let kernels = &mut self.kernels;
            self.passes =
                Passes::new(&self.gpu, &self.scene, &targets, &spec, kernels, &targets.display, None)?;
            (self.targets, self.has_target) = (targets, has_target);
            self.forget_linked();
            self.sequence = Sequence::new(&settings);
        }
        if settings != self.spec.settings {
            self.sequence.reset();
        }
        self.spec = spec;
        Ok(())
    }

    /// The current settings, with `auto` replaced by what it was resolved to.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.spec.settings
    }

    /// The next frame as command buffers, to be submitted to the device's queue in order; other work may be
    /// submitted in between. Each is recorded when the iterator reaches it and holds bounded work. Once the queue
    /// has executed the last one, [`Renderer::display`] holds the frame. This neither submits nor waits.
    ///
    /// A frame counts as rendered once its last command buffer has been handed out: the next frame continues from
    /// it. If the iterator is dropped earlier, the frame was given up (see [`Renderer::render_until`]), whether
    /// or not the caller submits the buffers already handed out. A caller that does not submit a completely
    /// handed out frame calls [`Renderer::restart`].
    ///
    /// ```no_run
    /// # fn example(renderer: &mut glimpse::Renderer, camera: &glimpse::Camera, queue: &glimpse::wgpu::Queue)
    /// # -> glimpse::Result<()> {
    /// for commands in renderer.frame(camera)? {
    ///     queue.submit([commands]);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// The method cannot use the camera, or the device failed.
    pub fn frame(&mut self, camera: &Camera) -> Result<FrameCommands<'_>> {
        let step = self.sequence.next(camera);
        let constants = self.constants(camera, &step)?;
        let Self { gpu, targets, passes, spec: FrameSpec { settings, .. }, sequence, .. } = self;
        let cleared = if step.clears { vec![&targets.samples] } else { Vec::new() };
        let commands = passes.commands(gpu, targets, &constants, &settings.tolerances, step.side, cleared)?;
        Ok(FrameCommands::new(commands, sequence, step, camera))
    }

    /// Renders a frame and waits for it. Uses the kernels without counters, so that its time can be measured.
    ///
    /// # Errors
    /// The errors of [`Renderer::frame`].
    pub fn render(&mut self, camera: &Camera) -> Result<FrameTime> {
        let gpu = self.gpu.clone();
        gpu.submit_all_and_wait(self.frame(camera)?)?;
        self.frame_time()
    }

    /// Like [`Renderer::render`], but calls `cancelled` before each submission, with the share of the submissions that are
    /// made (from 0, below 1), and gives the frame up when it returns true. Then the result is `None`, and
    /// [`Renderer::display`] holds parts of two frames.
    ///
    /// # Errors
    /// The errors of [`Renderer::frame`].
    pub fn render_until(
        &mut self,
        camera: &Camera,
        cancelled: &dyn Fn(f32) -> bool,
    ) -> Result<Option<FrameTime>> {
        let gpu = self.gpu.clone();
        let done = gpu.submit_until(self.frame(camera)?, cancelled)?;
        done.then(|| self.frame_time()).transpose()
    }

    /// GPU time of the last submitted frame from timestamps; waits for the frame. Zero where the device has no
    /// timestamps.
    ///
    /// # Errors
    /// The device failed.
    pub fn frame_time(&self) -> Result<FrameTime> {
        self.passes.times(&self.gpu)
    }

    /// Starts a new sequence: the next frame reuses nothing of earlier ones.
    pub fn restart(&mut self) {
        self.sequence.reset();
    }

    /// Whether another frame of the last camera would be identical. False while a method that [keeps
    /// frames](Method::has_history) still shows pixels from before the camera came to rest, or lacks samples.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        !self.spec.settings.method.has_history() || self.sequence.is_settled()
    }

    /// Samples of each pixel in the last frame, those added by [`Renderer::accumulate`] included; 1 for methods
    /// that do not accumulate samples.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.sequence.frames().saturating_add(self.sequence.merged())
    }

    /// Number of kernels compiled so far. A frame after the number has grown takes longer, as some drivers
    /// compile a kernel when it first runs.
    #[must_use]
    pub fn kernels(&self) -> usize {
        self.kernels.count()
    }

    /// The frame as a texture on the device: sRGB-encoded, 8 bits per channel, in a format that does not decode.
    #[must_use]
    pub fn display(&self) -> &wgpu::Texture {
        &self.targets.display
    }

    /// Renders the frame again with counting kernels, which are linked on the first call. In a sequence it
    /// repeats the last frame; if the camera is that frame's, later frames are not affected.
    ///
    /// # Errors
    /// The device failed.
    pub fn inspect(&mut self, camera: &Camera) -> Result<Inspection> {
        let (passes, buffer) = match self.inspecting.take() {
            Some(linked) => linked,
            None => {
                let output = shown(&self.spec.settings);
                let display = self.targets.display.clone();
                self.link_counting(output, &display)?
            }
        };
        let inspection = self.count(camera, &passes, &buffer)?;
        self.inspecting = Some((passes, buffer));
        Ok(inspection)
    }

    /// The result of [`Renderer::inspect`] and the frame's linear radiance from the same kernels: half as many to
    /// compile as for calling `inspect` and [`Renderer::linear_image`].
    ///
    /// # Errors
    /// The device failed.
    pub fn inspect_linear(&mut self, camera: &Camera) -> Result<(Inspection, LinearImage)> {
        let target = self.linear_target()?;
        let (passes, buffer) = self.link_counting(Output::Linear, &target)?;
        Ok((self.count(camera, &passes, &buffer)?, self.read_linear(&target)?))
    }

    /// Links the counting passes and allocates the buffer that they count in.
    fn link_counting(&mut self, output: Output, target: &wgpu::Texture) -> Result<(Passes, wgpu::Buffer)> {
        let buffer = inspection_buffer(&self.gpu, self.records())?;
        let spec = FrameSpec { inspect: true, records: self.records() > 0, output, ..self.spec };
        Ok((self.link(&spec, target, Some(&buffer))?, buffer))
    }

    fn count(&self, camera: &Camera, passes: &Passes, buffer: &wgpu::Buffer) -> Result<Inspection> {
        let step = self.sequence.again(camera);
        self.run(passes, camera, &step, Some(buffer))?;
        let bytes = self.gpu.read_buffer(buffer)?;
        let inspection = inspection::decode(&bytes, self.targets.grid, self.records());
        if inspection.uncorrected > 0 {
            log::warn!("postcorrection found {} samples that it did not come to", inspection.uncorrected);
        }
        Ok(inspection)
    }

    /// Reads the last frame back as sRGB pixels.
    ///
    /// # Errors
    /// The device failed, or a [target](Renderer::set_target) of the caller cannot be read back.
    pub fn display_image(&self) -> Result<DisplayImage> {
        let [width, height] = self.targets.size;
        target::check_readback(&self.targets.display)?;
        let bytes = self.gpu.read_texture(&self.targets.display, 4)?;
        DisplayImage::from_raw(width, height, bytes).ok_or_else(|| Error::Device("short readback".into()))
    }

    /// Renders a frame in linear radiance; the kernels for it are linked on the first call. It starts a new
    /// sequence, and so does the next rendered frame. With path tracing it takes as many samples as the last
    /// frame; if that frame has samples from [`Renderer::accumulate`] and this camera, it is the last frame
    /// itself.
    ///
    /// # Errors
    /// The device failed.
    pub fn linear_image(&mut self, camera: &Camera) -> Result<LinearImage> {
        #[cfg(feature = "reference")]
        if self.sequence.merged() > 0 && self.sequence.camera() == Some(*camera) {
            return self.accumulated_image(camera);
        }
        let (passes, target) = self.linear()?;
        let frames = self.sequence.frames();
        self.sequence.reset();
        for _ in 0..frames {
            let step = self.sequence.next(camera);
            self.run(&passes, camera, &step, None)?;
            self.sequence.done(step, camera);
        }
        self.sequence.reset();
        let image = self.read_linear(&target)?;
        self.linear = Some((passes, target));
        Ok(image)
    }

    /// The passes that write linear radiance, and the texture that they write.
    fn linear(&mut self) -> Result<(Passes, wgpu::Texture)> {
        if let Some(linked) = self.linear.take() {
            return Ok(linked);
        }
        let target = self.linear_target()?;
        let spec = FrameSpec { output: Output::Linear, ..self.spec };
        Ok((self.link(&spec, &target, None)?, target))
    }

    fn linear_target(&self) -> Result<wgpu::Texture> {
        texture(&self.gpu, "linear", self.targets.size, wgpu::TextureFormat::Rgba32Float)
    }

    fn read_linear(&self, target: &wgpu::Texture) -> Result<LinearImage> {
        let [width, height] = self.targets.size;
        let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&self.gpu.read_texture(target, 16)?);
        let rgb = texels.iter().flat_map(|t| [t[0], t[1], t[2]]).collect();
        LinearImage::from_raw(width, height, rgb).ok_or_else(|| Error::Device("short readback".into()))
    }

    /// The denoiser's G-buffer of the last frame, row by row from the top left: four words per pixel, which
    /// [`GBufferPixel::unpacked`](crate::reference::GBufferPixel::unpacked) decodes. Empty without a denoiser.
    ///
    /// # Errors
    /// The device failed.
    pub fn gbuffer(&self) -> Result<Vec<[u32; 4]>> {
        if self.spec.settings.denoise() == Denoise::Off {
            return Ok(Vec::new());
        }
        Ok(bytemuck::pod_collect_to_vec(&self.gpu.read_buffer(&self.targets.gbuffer)?))
    }

    /// Bytes that the scene and the frame's buffers and images occupy on the device, without counting kernels'
    /// buffers.
    #[must_use]
    pub fn memory(&self) -> Memory {
        self.targets.memory(&self.scene)
    }

    /// Drops the passes other than those of [`Renderer::frame`]; they are linked again when next needed.
    fn forget_linked(&mut self) {
        (self.inspecting, self.linear) = (None, None);
        #[cfg(feature = "reference")]
        {
            self.accumulating = None;
        }
    }

    fn records(&self) -> u64 {
        records(&self.gpu, self.targets.size, &self.spec.settings)
    }

    fn link(
        &mut self,
        spec: &FrameSpec,
        color: &wgpu::Texture,
        inspection: Option<&wgpu::Buffer>,
    ) -> Result<Passes> {
        let Self { gpu, scene, targets, kernels, .. } = self;
        Passes::new(gpu, scene, targets, spec, kernels, color, inspection)
    }

    fn constants(&self, camera: &Camera, step: &Step) -> Result<FrameUniform> {
        if self.spec.settings.method == Method::Vr && camera.orthographic {
            let expected = "a perspective camera with method vr";
            return Err(Error::setting("camera", expected, "an orthographic one, which has no eyes"));
        }
        let frame = FrameUniform::new(&self.scene, &self.spec.settings, self.targets.grid, camera);
        let ambient = if self.spec.preview { [PREVIEW_AMBIENT; 3] } else { frame.ambient };
        Ok(FrameUniform {
            ambient,
            refresh_first: step.first,
            refresh_count: step.count,
            still: u32::from(step.still),
            paths: FramePaths { sample: step.sample, merged: step.merged, ..frame.paths },
            ..frame
        })
    }

    /// Renders a frame with `passes` instead of those of [`Renderer::frame`] and waits for it.
    fn run(
        &self,
        passes: &Passes,
        camera: &Camera,
        step: &Step,
        counted: Option<&wgpu::Buffer>,
    ) -> Result<()> {
        let constants = self.constants(camera, step)?;
        let samples = step.clears.then_some(&self.targets.samples);
        let cleared = counted.into_iter().chain(samples).collect();
        let tolerances = &self.spec.settings.tolerances;
        let commands =
            passes.commands(&self.gpu, &self.targets, &constants, tolerances, step.side, cleared)?;
        self.gpu.submit_all_and_wait(commands)
    }
}

/// Number of pixel records: one for each pixel if it has a single sample and the device can hold them all, else 0.
fn records(gpu: &Gpu, size: [u32; 2], settings: &Settings) -> u64 {
    let records = size.map(u64::from).iter().product();
    if settings.sampling == 1 && inspection_fits(gpu, records) { records } else { 0 }
}

/// Where counting kernels write colours.
fn shown(settings: &Settings) -> Output {
    if settings.sampling > 1 { Output::Nowhere } else { Output::Display }
}

/// The settings with `auto` resolved: exposure by the scene, and `postcorrect`, of which `auto` becomes on or off, and other methods than adaptive have none.
fn resolved(settings: &Settings, scene: &GpuScene, [_, height]: [u32; 2]) -> Settings {
    let thin = || scene.is_thin(height.saturating_mul(settings.sampling), settings.block);
    let postcorrect = match (settings.method, settings.postcorrect) {
        (Method::Adaptive, Postcorrect::Auto) if settings.block > 2 || thin() => Postcorrect::On,
        (Method::Adaptive, Postcorrect::Auto) => Postcorrect::Off,
        (Method::Adaptive, wished) => wished,
        _ => Postcorrect::Off,
    };
    Settings { postcorrect, ..scene.exposed(settings) }
}

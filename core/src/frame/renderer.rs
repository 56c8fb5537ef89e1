//! The renderer: frames of one size and one method of one scene.

#[cfg(feature = "reference")]
mod accumulate;
mod commands;
mod target;

pub use commands::FrameCommands;

use crate::{
    Camera, Denoise, DisplayImage, Error, FrameTime, Gpu, GpuScene, Inspection, LinearImage, Memory, Method,
    Paths, Postcorrect, Result, Settings,
    device::Kernels,
    frame::inspection,
    frame::recorder::{FramePaths, FrameUniform, Passes},
    frame::sequence::{Sequence, Step},
    frame::targets::{Targets, inspection_buffer, inspection_fits, texture},
    passes::{FrameSpec, Output},
};

/// Renders frames of one size of one scene. It holds handles to the device and the scene, so both live as long as it does.
///
/// With a method that [keeps frames](Method::has_history) they are a sequence: the first traces every pixel, and so does
/// the first after another size, other settings or [`Renderer::linear_image`]. A frame that was given up is none of them.
pub struct Renderer {
    gpu: Gpu,
    scene: GpuScene,
    settings: Settings,
    targets: Targets,
    kernels: Kernels,
    passes: Passes,
    sequence: Sequence,
    /// The display image is the caller's.
    has_target: bool,
    inspecting: Option<(Passes, wgpu::Buffer)>,
    linear: Option<(Passes, wgpu::Texture)>,
    #[cfg(feature = "reference")]
    accumulating: Option<crate::cpu_tracer::AccumulatePass>,
}

impl Renderer {
    /// Links and compiles the kernels, makes the targets.
    ///
    /// # Errors
    /// Invalid settings or size, or a device that cannot.
    pub fn new(gpu: &Gpu, scene: &GpuScene, size: [u32; 2], settings: &Settings) -> Result<Self> {
        settings.validate()?;
        let settings = resolved(settings, scene, size);
        let spec = FrameSpec::new(scene, &settings);
        let targets = Targets::new(gpu, &spec, size)?;
        let mut kernels = Kernels::default();
        let passes = Passes::new(gpu, scene, &targets, &spec, &mut kernels, &targets.display, None)?;
        let sequence = Sequence::new(&settings);
        Ok(Self {
            gpu: gpu.clone(),
            scene: scene.clone(),
            settings,
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

    /// Goes on with another size or other settings: what was compiled is kept. On an error everything is as before.
    ///
    /// # Errors
    /// As [`Renderer::new`].
    pub fn change(&mut self, size: [u32; 2], settings: &Settings) -> Result<()> {
        settings.validate()?;
        let settings = resolved(settings, &self.scene, size);
        let Settings { tolerances, min_weight, .. } = settings;
        let gaze = settings.paths.gaze;
        // Those are constants of a frame and no more.
        if size != self.targets.size
            || settings
                != (Settings {
                    tolerances,
                    min_weight,
                    paths: Paths { gaze, ..self.settings.paths },
                    ..self.settings
                })
        {
            let spec = FrameSpec::new(&self.scene, &settings);
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
        if settings != self.settings {
            self.sequence.reset();
        }
        self.settings = settings;
        Ok(())
    }

    /// What frames are made by: as wished, with what `auto` has come to.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The next frame as command buffers, to be submitted in order to the device's queue, with other work in between or not;
    /// each is recorded when it is asked for and holds bounded work. Once the queue has done the last of them,
    /// [`Renderer::display`] holds the frame. This neither submits nor waits.
    ///
    /// A frame counts as made once its last command buffer has been handed out: the next one goes on from it. Dropped
    /// earlier, it was given up (see [`Renderer::render_until`]); what was handed out of it may then be submitted or not. Who
    /// does not submit a frame that was handed out whole calls [`Renderer::restart`].
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
    /// A camera that the method cannot use, or a device that failed.
    pub fn frame(&mut self, camera: &Camera) -> Result<FrameCommands<'_>> {
        let step = self.sequence.next(camera);
        let constants = self.constants(camera, &step)?;
        let Self { gpu, targets, passes, settings, sequence, .. } = self;
        let cleared = if step.clears { vec![&targets.samples] } else { Vec::new() };
        let commands = passes.commands(gpu, targets, &constants, &settings.tolerances, step.side, cleared)?;
        Ok(FrameCommands::new(commands, sequence, step, camera))
    }

    /// Renders a frame and waits for it; the timed path: nothing is counted.
    ///
    /// # Errors
    /// As [`Renderer::frame`].
    pub fn render(&mut self, camera: &Camera) -> Result<FrameTime> {
        let gpu = self.gpu.clone();
        gpu.submit_all_and_wait(self.frame(camera)?)?;
        self.frame_time()
    }

    /// As [`Renderer::render`], given up between two submissions once `cancelled` says so: `None`, and what
    /// [`Renderer::display`] holds is part of one frame and part of another.
    ///
    /// # Errors
    /// As [`Renderer::frame`].
    pub fn render_until(
        &mut self,
        camera: &Camera,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<Option<FrameTime>> {
        let gpu = self.gpu.clone();
        let done = gpu.submit_until(self.frame(camera)?, cancelled)?;
        done.then(|| self.frame_time()).transpose()
    }

    /// The time of the last frame that was submitted, by the device's timestamps; waits for it. Zero where the device has no
    /// timestamps.
    ///
    /// # Errors
    /// A device that failed.
    pub fn frame_time(&self) -> Result<FrameTime> {
        self.passes.times(&self.gpu)
    }

    /// The next frame follows on nothing: where frames are a sequence it is the first of one.
    pub fn restart(&mut self) {
        self.sequence.reset();
    }

    /// Whether another frame of the last camera would show the same: every pixel shows what a ray through its centre sees.
    /// False where a method that [keeps frames](Method::has_history) has not yet renewed all that it kept from before the
    /// camera came to rest.
    #[must_use]
    pub fn is_settled(&self) -> bool {
        !self.settings.method.has_history() || self.sequence.is_settled()
    }

    /// How many samples of paths are shown in each pixel, those that were [merged](Renderer::accumulate) among them; 1 of methods
    /// that do not add them up.
    #[must_use]
    pub fn samples(&self) -> u32 {
        self.sequence.frames().saturating_add(self.sequence.merged())
    }

    /// How many kernels have been compiled so far: a frame after it has grown takes longer than others, as some drivers
    /// compile when a kernel runs for the first time.
    #[must_use]
    pub fn kernels(&self) -> usize {
        self.kernels.count()
    }

    /// The frame on the device: sRGB, 8 bits a channel, the encoding undone nowhere.
    #[must_use]
    pub fn display(&self) -> &wgpu::Texture {
        &self.targets.display
    }

    /// Renders the same frame with counting kernels (they are linked on the first call). Of a sequence it is the last frame
    /// once more, which changes nothing for those that follow, if the camera is that of the last frame.
    ///
    /// # Errors
    /// A device that failed.
    pub fn inspect(&mut self, camera: &Camera) -> Result<Inspection> {
        let (passes, buffer) = match self.inspecting.take() {
            Some(linked) => linked,
            None => {
                let output = if self.settings.sampling > 1 { Output::Nowhere } else { Output::Display };
                let display = self.targets.display.clone();
                self.link_counting(output, &display)?
            }
        };
        let inspection = self.count(camera, &passes, &buffer)?;
        self.inspecting = Some((passes, buffer));
        Ok(inspection)
    }

    /// What [`Renderer::inspect`] gives and the linear radiance that the counting kernels compute, which are half as many to compile
    /// as those of `inspect` and [`Renderer::linear_image`].
    ///
    /// # Errors
    /// A device that failed.
    pub fn inspect_linear(&mut self, camera: &Camera) -> Result<(Inspection, LinearImage)> {
        let target = self.linear_target()?;
        let (passes, buffer) = self.link_counting(Output::Linear, &target)?;
        Ok((self.count(camera, &passes, &buffer)?, self.read_linear(&target)?))
    }

    /// The counting passes, and what they count in.
    fn link_counting(&mut self, output: Output, target: &wgpu::Texture) -> Result<(Passes, wgpu::Buffer)> {
        let buffer = inspection_buffer(&self.gpu, self.records())?;
        let records = self.records() > 0;
        let spec =
            FrameSpec { inspect: true, records, output, ..FrameSpec::new(&self.scene, &self.settings) };
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

    /// The last frame as shown.
    ///
    /// # Errors
    /// A device that failed.
    pub fn display_image(&self) -> Result<DisplayImage> {
        let [width, height] = self.targets.size;
        target::check_readback(&self.targets.display)?;
        let bytes = self.gpu.read_texture(&self.targets.display, 4)?;
        DisplayImage::from_raw(width, height, bytes).ok_or_else(|| Error::Device("short readback".into()))
    }

    /// The frame of this camera in linear radiance (kernels that write it are linked on the first call). Where frames are a
    /// sequence, this is the first of one, and so is the next that is rendered; of paths, there are as many samples in it as in
    /// the last frame; with samples that were [merged](Renderer::accumulate) it is the last frame itself.
    ///
    /// # Errors
    /// A device that failed.
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

    /// The passes that write linear radiance, and where to.
    fn linear(&mut self) -> Result<(Passes, wgpu::Texture)> {
        if let Some(linked) = self.linear.take() {
            return Ok(linked);
        }
        let target = self.linear_target()?;
        let spec = FrameSpec { output: Output::Linear, ..FrameSpec::new(&self.scene, &self.settings) };
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

    /// What guides the removal of noise in each pixel of the last frame, row by row: the words that
    /// [`GBufferPixel::unpacked`](crate::reference::GBufferPixel::unpacked) takes. None where nothing is done about noise.
    ///
    /// # Errors
    /// A device that failed.
    pub fn gbuffer(&self) -> Result<Vec<[u32; 4]>> {
        if self.settings.denoise() == Denoise::Off {
            return Ok(Vec::new());
        }
        Ok(bytemuck::pod_collect_to_vec(&self.gpu.read_buffer(&self.targets.gbuffer)?))
    }

    /// Bytes on the device for timed frames.
    #[must_use]
    pub fn memory(&self) -> Memory {
        self.targets.memory(&self.scene)
    }

    /// Passes beside those of [`Renderer::frame`] are linked again when they are next needed.
    fn forget_linked(&mut self) {
        (self.inspecting, self.linear) = (None, None);
        #[cfg(feature = "reference")]
        {
            self.accumulating = None;
        }
    }

    /// Pixels have a record each if they are one sample and the device can hold so many.
    fn records(&self) -> u64 {
        let [width, height] = self.targets.size.map(u64::from);
        let records = width * height;
        if self.settings.sampling == 1 && inspection_fits(&self.gpu, records) { records } else { 0 }
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
        if self.settings.method == Method::Vr && camera.orthographic {
            let expected = "a perspective camera with method vr";
            return Err(Error::setting("camera", expected, "an orthographic one, which has no eyes"));
        }
        let frame = FrameUniform::new(&self.scene, &self.settings, self.targets.grid, camera);
        Ok(FrameUniform {
            refresh_first: step.first,
            refresh_count: step.count,
            still: u32::from(step.still),
            paths: FramePaths { sample: step.sample, merged: step.merged, ..frame.paths },
            ..frame
        })
    }

    /// Renders a frame by other passes than those of [`Renderer::frame`] and waits for it.
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
        let tolerances = &self.settings.tolerances;
        let commands =
            passes.commands(&self.gpu, &self.targets, &constants, tolerances, step.side, cleared)?;
        self.gpu.submit_all_and_wait(commands)
    }
}

/// The settings with a decision about postcorrection.
fn resolved(settings: &Settings, scene: &GpuScene, [_, height]: [u32; 2]) -> Settings {
    let thin = || scene.is_thin(height.saturating_mul(settings.sampling), settings.block);
    let postcorrect = match (settings.method, settings.postcorrect) {
        (Method::Adaptive, Postcorrect::Auto) if settings.block > 2 || thin() => Postcorrect::On,
        (Method::Adaptive, Postcorrect::Auto) => Postcorrect::Off,
        (Method::Adaptive, wished) => wished,
        _ => Postcorrect::Off,
    };
    Settings { postcorrect, ..*settings }
}

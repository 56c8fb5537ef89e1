//! Renders the frames of one scene on the worker thread. While kernels of a frame are compiled, the last renderer or a
//! preview stands in for it.

mod kernels;

use std::sync::Arc;

use glam::Vec3;
use glimpse::{
    Camera, Counts, DisplayImage, Error, Gpu, GpuScene, Memory, Method, PassTime, Purpose, Renderer, Result,
    Robustness, Settings, Show, metrics,
    probe::{Probe, ProbeHit, ProbeRay},
    show,
};

use crate::{
    compiler::{CompileRequest, Compiler},
    mailbox::{Mailbox, Order},
    worker::{EventSender, WorkerEvent},
};
use kernels::{Needs, Waiting};

/// Everything that determines a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The camera.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The rendering settings.
    pub settings: Settings,
    /// The quantity that the picture shows.
    pub show: Show,
    /// Whether to render the frame by full ray tracing as well, for comparison.
    pub split: bool,
    /// The governor's level while the camera moves; `None` for a frame at rest. Only frames at rest are
    /// counted, and only they can be cancelled.
    pub level: Option<usize>,
    /// Whether this is the refined frame of a view at rest, which follows the chosen one and is not counted.
    pub is_refined: bool,
}

impl Job {
    /// Whether the job is for a frame at rest.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.level.is_none()
    }

    /// Whether rays are counted once the frame is complete: those of the frame at rest as it was chosen.
    #[must_use]
    pub fn is_counted(&self) -> bool {
        self.is_still() && !self.is_refined
    }
}

/// A rendered frame.
pub struct RenderedFrame {
    /// Number of the request.
    pub number: u64,
    /// Job that it was rendered for.
    pub job: Job,
    /// The picture: sRGB-encoded RGBA, 8 bits per channel.
    pub picture: Arc<wgpu::Texture>,
    /// The same frame by full ray tracing, if the job asks for it.
    pub full: Option<Arc<wgpu::Texture>>,
    /// Rendering time on the device in milliseconds.
    pub ms: f64,
    /// Whether this is another frame from the job's camera, shown until the kernels of the job's own are compiled.
    pub is_stand_in: bool,
    /// Whether rendering the job again would give the same picture.
    pub settled: bool,
    /// Samples of a pixel that are rendered, over those that the method accumulates, up to 1.
    pub samples_share: f32,
    /// Whether kernels were compiled during the frame, so that its time is not representative.
    pub compiled: bool,
    /// Time of each pass.
    pub passes: Vec<PassTime>,
    /// Device memory in use, in bytes.
    pub memory: Memory,
    /// Legend of the quantity shown; empty for the final picture.
    pub legend: String,
}

/// Statistics of a frame at rest, sent after the frame itself.
#[derive(Clone, Debug)]
pub struct Counted {
    /// Numbers of rays, samples and failed checks.
    pub counts: Counts,
    /// PSNR in dB against full ray tracing, if the job asks for both; infinite if the pictures are equal.
    pub psnr_db: Option<f64>,
}

/// The renderers of one scene.
pub(crate) struct SceneRenderer<'a> {
    gpu: &'a Gpu,
    scene: &'a GpuScene,
    mailbox: &'a Mailbox,
    compiler: &'a Compiler,
    event_sender: &'a EventSender,
    shown: Option<Renderer>,
    full: Option<Renderer>,
    preview: Option<Renderer>,
    /// What waits for kernels.
    waiting: Waiting,
    /// The kernels that are being compiled.
    requested: Option<Needs>,
    /// Kernels that were found compiled last.
    ready: Option<Needs>,
    /// Textures given to the app. Those that the app has dropped are reused.
    pictures: Vec<Arc<wgpu::Texture>>,
}

impl<'a> SceneRenderer<'a> {
    pub fn new(
        gpu: &'a Gpu,
        scene: &'a GpuScene,
        mailbox: &'a Mailbox,
        compiler: &'a Compiler,
        event_sender: &'a EventSender,
    ) -> Self {
        Self {
            gpu,
            scene,
            mailbox,
            compiler,
            event_sender,
            shown: None,
            full: None,
            preview: None,
            waiting: Waiting::default(),
            requested: None,
            ready: None,
            pictures: Vec::new(),
        }
    }

    /// Serves requests until another scene is waiting or the thread must end.
    ///
    /// # Errors
    /// Fails if the device is lost.
    pub fn serve(mut self) -> std::result::Result<(), String> {
        loop {
            let result = match self.mailbox.next() {
                Order::Leave => return Ok(()),
                Order::Frame(number, job) => self.frame(number, job),
                Order::Capture(job) => self.capture(job),
                Order::Pick(camera, at) => {
                    self.pick(&camera, at).map(|point| self.event_sender.send(WorkerEvent::Picked(point)))
                }
                Order::Compiled(compiled) => self.compiled(compiled),
            };
            match result {
                Ok(()) => {}
                Err(error @ (Error::Lost { .. } | Error::Timeout { .. })) => return Err(error.to_string()),
                Err(error) => self.event_sender.send(WorkerEvent::Failed(error.to_string())),
            }
        }
    }

    fn frame(&mut self, number: u64, job: Job) -> Result<()> {
        if let Some((earlier, ..)) = self.waiting.count.take() {
            self.event_sender.send(WorkerEvent::Cancelled(earlier));
        }
        let missing = self.missing(Needs::of(&job))?;
        if !missing.is_empty() {
            return self.stand_in(number, job, missing);
        }
        self.waiting.frame = None;
        let (gpu, scene, mailbox, event_sender) = (self.gpu, self.scene, self.mailbox, self.event_sender);
        let cancelled = |share| {
            if job.is_still() {
                event_sender.send(WorkerEvent::Rendering(number, share));
            }
            job.is_still() && mailbox.is_urgent()
        };
        let known = self.shown.as_ref().map_or(0, Renderer::kernels);
        let renderer = changed(&mut self.shown, gpu, scene, job.size, &job.settings)?;
        let Some(time) = renderer.render_until(&job.camera, &cancelled)? else {
            event_sender.send(WorkerEvent::Cancelled(number));
            return Ok(());
        };
        let compiled = renderer.kernels() > known;
        let (memory, settled) = (renderer.memory(), renderer.is_settled());
        let samples_share = renderer.samples() as f32 / job.settings.paths.samples.max(1) as f32;
        let (picture, legend) = if job.show == Show::Final {
            let display = renderer.display().clone();
            (self.handed_out(&display), String::new())
        } else {
            let inspection = renderer.inspect(&job.camera)?;
            let (picture, legend) = show::picture(job.show, &renderer.display_image()?, &inspection.pixels)?;
            (self.uploaded(&picture), legend)
        };
        let full = if job.split {
            let renderer = changed(&mut self.full, gpu, scene, job.size, &full(&job.settings))?;
            if renderer.render_until(&job.camera, &cancelled)?.is_none() {
                event_sender.send(WorkerEvent::Cancelled(number));
                return Ok(());
            }
            let display = renderer.display().clone();
            Some(self.handed_out(&display))
        } else {
            None
        };
        let (camera, split) = (job.camera, job.split);
        let is_counted = job.is_counted();
        let (ms, passes) = (time.ms, time.passes);
        event_sender.send(WorkerEvent::Frame(Box::new(RenderedFrame {
            number,
            job,
            picture,
            full,
            ms,
            is_stand_in: false,
            settled,
            samples_share,
            compiled,
            passes,
            memory,
            legend,
        })));
        if is_counted && settled { self.count(number, camera, split) } else { Ok(()) }
    }

    /// Sends the counters of the last frame once their kernels are compiled, unless another request waits.
    fn count(&mut self, number: u64, camera: Camera, split: bool) -> Result<()> {
        if self.mailbox.is_urgent() {
            self.event_sender.send(WorkerEvent::Cancelled(number));
            return Ok(());
        }
        let missing = match &self.shown {
            Some(shown) => {
                let size = [shown.display().width(), shown.display().height()];
                self.uncompiled(size, shown.settings(), Purpose::Counters)?
            }
            None => None,
        };
        if let Some(kernels) = missing {
            self.requested = None;
            self.waiting.count = Some((number, camera, split));
            self.compiler.request(CompileRequest { renderers: [kernels].into(), is_told: false });
            return Ok(());
        }
        let counted = self.counted(&camera, split)?;
        self.event_sender.send(WorkerEvent::Counted(number, Box::new(counted)));
        Ok(())
    }

    /// Counts rays, samples and failed checks of the last frame, and compares it with full ray tracing if
    /// `split` is set.
    fn counted(&mut self, camera: &Camera, split: bool) -> Result<Counted> {
        let psnr_db = match (&self.shown, &self.full) {
            (Some(shown), Some(full)) if split => {
                let rmse = metrics::rmse(&shown.display_image()?, &full.display_image()?)?;
                Some(metrics::psnr_db(rmse).unwrap_or(f64::INFINITY))
            }
            _ => None,
        };
        let counts = match &mut self.shown {
            Some(renderer) => renderer.inspect(camera)?.counts,
            None => Counts::default(),
        };
        Ok(Counted { counts, psnr_db })
    }

    /// Sends a frame as an image once its kernels are compiled.
    fn capture(&mut self, job: Job) -> Result<()> {
        let missing = self.missing(Needs::of(&job))?;
        if missing.is_empty() {
            let image = self.captured(&job)?;
            self.event_sender.send(WorkerEvent::Captured(image));
        } else {
            self.request(Needs::of(&job), missing);
            self.waiting.capture = Some(job);
        }
        Ok(())
    }

    fn captured(&mut self, job: &Job) -> Result<DisplayImage> {
        let renderer = changed(&mut self.shown, self.gpu, self.scene, job.size, &job.settings)?;
        renderer.render(&job.camera)?;
        while !renderer.is_settled() {
            renderer.render(&job.camera)?;
        }
        let image = renderer.display_image()?;
        if job.show == Show::Final {
            return Ok(image);
        }
        let inspection = renderer.inspect(&job.camera)?;
        Ok(show::picture(job.show, &image, &inspection.pixels)?.0)
    }

    fn pick(&self, camera: &Camera, at: [f32; 2]) -> Result<Option<Vec3>> {
        let (origin, direction) = camera.through(at);
        let ray = ProbeRay {
            origin: origin.into(),
            t_max: f32::MAX,
            direction: direction.into(),
            ..ProbeRay::default()
        };
        let (hits, _) = Probe::new(self.gpu, self.scene, Robustness::default()).trace(&[ray])?;
        let hit = hits.first().filter(|hit| hit.primitive != ProbeHit::MISS);
        Ok(hit.map(|hit| origin + hit.t * direction))
    }

    /// Copies a renderer's picture into a texture for the app.
    fn handed_out(&mut self, source: &wgpu::Texture) -> Arc<wgpu::Texture> {
        let picture = self.picture(source.width(), source.height());
        let mut encoder = self.gpu.device().create_command_encoder(&Default::default());
        encoder.copy_texture_to_texture(source.as_image_copy(), picture.as_image_copy(), source.size());
        self.gpu.queue().submit([encoder.finish()]);
        picture
    }

    fn uploaded(&mut self, image: &DisplayImage) -> Arc<wgpu::Texture> {
        let picture = self.picture(image.width(), image.height());
        self.gpu.queue().write_texture(
            picture.as_image_copy(),
            image.as_raw(),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * image.width()),
                rows_per_image: None,
            },
            picture.size(),
        );
        picture
    }

    /// A texture that the app does not hold, reused or new.
    fn picture(&mut self, width: u32, height: u32) -> Arc<wgpu::Texture> {
        self.pictures.retain(|p| (p.width(), p.height()) == (width, height));
        if let Some(free) = self.pictures.iter().find(|p| Arc::strong_count(p) == 1) {
            return free.clone();
        }
        let picture = Arc::new(self.gpu.device().create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        }));
        self.pictures.push(picture.clone());
        picture
    }
}

/// The settings of the picture for comparison.
fn full(settings: &Settings) -> Settings {
    Settings { method: Method::Full, ..*settings }
}

/// The renderer for that size and those settings, created or changed as needed.
fn changed<'r>(
    renderer: &'r mut Option<Renderer>,
    gpu: &Gpu,
    scene: &GpuScene,
    size: [u32; 2],
    settings: &Settings,
) -> Result<&'r mut Renderer> {
    if let Some(renderer) = renderer {
        renderer.change(size, settings)?;
        return Ok(renderer);
    }
    Ok(renderer.insert(Renderer::new(gpu, scene, size, settings)?))
}

//! Renders the frames of one scene on the worker thread.

use std::sync::Arc;

use glam::Vec3;
use glimpse::{
    Camera, Counts, DisplayImage, Error, Gpu, GpuScene, Memory, Method, PassTime, Renderer, Result,
    Robustness, Settings, Show, metrics,
    probe::{Probe, ProbeHit, ProbeRay},
    show,
};

use crate::{
    mailbox::{Mailbox, Order},
    worker::{EventSender, WorkerEvent},
};

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
}

impl Job {
    /// Whether the job is for a frame at rest.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.level.is_none()
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
    /// Whether rendering the job again would give the same picture.
    pub settled: bool,
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
    shown: Option<Renderer>,
    full: Option<Renderer>,
    /// Textures given to the app. Those that the app has dropped are reused.
    pictures: Vec<Arc<wgpu::Texture>>,
}

impl<'a> SceneRenderer<'a> {
    pub fn new(gpu: &'a Gpu, scene: &'a GpuScene) -> Self {
        Self { gpu, scene, shown: None, full: None, pictures: Vec::new() }
    }

    /// Serves requests until another scene is waiting or the thread must end.
    ///
    /// # Errors
    /// Fails if the device is lost.
    pub fn serve(mut self, mailbox: &Mailbox, event_sender: &EventSender) -> std::result::Result<(), String> {
        loop {
            let result = match mailbox.next() {
                Order::Leave => return Ok(()),
                Order::Frame(number, job) => self.frame(number, job, mailbox, event_sender),
                Order::Capture(job) => {
                    self.capture(&job).map(|image| event_sender.send(WorkerEvent::Captured(image)))
                }
                Order::Pick(camera, at) => {
                    self.pick(&camera, at).map(|point| event_sender.send(WorkerEvent::Picked(point)))
                }
            };
            match result {
                Ok(()) => {}
                Err(error @ (Error::Lost { .. } | Error::Timeout { .. })) => return Err(error.to_string()),
                Err(error) => event_sender.send(WorkerEvent::Failed(error.to_string())),
            }
        }
    }

    fn frame(&mut self, number: u64, job: Job, mailbox: &Mailbox, event_sender: &EventSender) -> Result<()> {
        let cancelled = || job.is_still() && mailbox.is_urgent();
        let known = self.shown.as_ref().map_or(0, Renderer::kernels);
        let renderer = changed(&mut self.shown, self.gpu, self.scene, job.size, &job.settings)?;
        let Some(time) = renderer.render_until(&job.camera, &cancelled)? else {
            event_sender.send(WorkerEvent::Cancelled(number));
            return Ok(());
        };
        let compiled = renderer.kernels() > known;
        let (memory, settled) = (renderer.memory(), renderer.is_settled());
        let (picture, legend) = if job.show == Show::Final {
            (self.handed_out(false)?, String::new())
        } else {
            let inspection = renderer.inspect(&job.camera)?;
            let (picture, legend) = show::picture(job.show, &renderer.display_image()?, &inspection.pixels)?;
            (self.uploaded(&picture), legend)
        };
        let full = if job.split {
            let settings = Settings { method: Method::Full, ..job.settings };
            let renderer = changed(&mut self.full, self.gpu, self.scene, job.size, &settings)?;
            if renderer.render_until(&job.camera, &cancelled)?.is_none() {
                event_sender.send(WorkerEvent::Cancelled(number));
                return Ok(());
            }
            Some(self.handed_out(true)?)
        } else {
            None
        };
        let (camera, still, split) = (job.camera, job.is_still(), job.split);
        let (ms, passes) = (time.ms, time.passes);
        event_sender.send(WorkerEvent::Frame(Box::new(RenderedFrame {
            number,
            job,
            picture,
            full,
            ms,
            settled,
            compiled,
            passes,
            memory,
            legend,
        })));
        if still && settled {
            event_sender.send(if mailbox.is_urgent() {
                WorkerEvent::Cancelled(number)
            } else {
                WorkerEvent::Counted(number, Box::new(self.count(&camera, split)?))
            });
        }
        Ok(())
    }

    /// Counts rays, samples and failed checks of the last frame, and compares it with full ray tracing if
    /// `split` is set.
    fn count(&mut self, camera: &Camera, split: bool) -> Result<Counted> {
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

    fn capture(&mut self, job: &Job) -> Result<DisplayImage> {
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

    /// Copies the last picture of one of the renderers into a texture for the app.
    fn handed_out(&mut self, full: bool) -> Result<Arc<wgpu::Texture>> {
        let Some(renderer) = (if full { &self.full } else { &self.shown }) else {
            return Err(Error::Device("no frame was made".to_owned()));
        };
        let source = renderer.display().clone();
        let picture = self.picture(source.width(), source.height());
        let mut encoder = self.gpu.device().create_command_encoder(&Default::default());
        encoder.copy_texture_to_texture(source.as_image_copy(), picture.as_image_copy(), source.size());
        self.gpu.queue().submit([encoder.finish()]);
        Ok(picture)
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

//! The graphics device with the worker and the painter that use it.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::Arc,
};

use glimpse::Gpu;

use crate::{Files, Painter, Painting, Wake, Worker};

/// After this many losses without a frame in between, a new device gets no worker and shows only the overlay.
pub(crate) const MAX_LOSSES: u32 = 3;

/// The graphics device with its painter and its worker. There is none before the first
/// [`DeviceState::attach`] or after a [`DeviceState::detach`].
pub(crate) struct DeviceState {
    files: Files,
    wake: Wake,
    attached: Option<Attached>,
    /// Number of devices lost since the last frame arrived.
    losses: u32,
}

struct Attached {
    gpu: Arc<Gpu>,
    painter: Painter,
    /// `None` if no thread could be started or too many devices were lost.
    worker: Option<Worker>,
    /// Whether the worker has a scene and answers requests for frames.
    has_scene: bool,
}

impl DeviceState {
    /// Creates the state without a device. Workers read scenes through `files` and call `wake` after each
    /// message.
    pub fn new(files: Files, wake: Wake) -> Self {
        Self { files, wake, attached: None, losses: 0 }
    }

    /// Attaches a device, to paint on targets of that format. `fonts` is the overlay's font texture, if the
    /// overlay has already sent it to an earlier painter.
    ///
    /// # Errors
    /// Fails if the worker's thread cannot be started; the device still paints.
    pub fn attach(
        &mut self,
        gpu: Arc<Gpu>,
        format: wgpu::TextureFormat,
        fonts: Option<egui::ColorImage>,
    ) -> std::io::Result<()> {
        let mut painter = Painter::new(&gpu, format);
        fonts.into_iter().for_each(|image| painter.load_fonts(&gpu, image));
        let (worker, error) = if self.losses >= MAX_LOSSES {
            (None, None)
        } else {
            match Worker::start(gpu.clone(), self.files.clone(), self.wake.clone()) {
                Ok(worker) => (Some(worker), None),
                Err(error) => (None, Some(error)),
            }
        };
        self.attached = Some(Attached { gpu, painter, worker, has_scene: false });
        error.map_or(Ok(()), Err)
    }

    /// Drops a lost device with its painter and worker; returns the number of losses since the last frame.
    pub fn detach(&mut self) -> u32 {
        self.attached = None;
        self.losses += 1;
        self.losses
    }

    /// The reason for the loss of the device, if it is lost.
    pub fn lost(&self) -> Option<&str> {
        self.attached.as_ref()?.gpu.lost()
    }

    /// Whether a device is attached.
    pub fn is_attached(&self) -> bool {
        self.attached.is_some()
    }

    /// Records that the worker has loaded a scene.
    pub fn scene_opened(&mut self) {
        self.attached.iter_mut().for_each(|attached| attached.has_scene = true);
    }

    /// Whether the worker has a scene to render.
    pub fn has_scene(&self) -> bool {
        self.attached.as_ref().is_some_and(|attached| attached.has_scene)
    }

    /// Records that a frame arrived, which resets the count of losses.
    pub fn frame_arrived(&mut self) {
        self.losses = 0;
    }

    /// The worker, with or without a scene.
    pub fn worker(&mut self) -> Option<&mut Worker> {
        self.attached.as_mut()?.worker.as_mut()
    }

    /// The worker, if it has a scene.
    pub fn ready_worker(&mut self) -> Option<&mut Worker> {
        if self.has_scene() { self.worker() } else { None }
    }

    /// Fingerprints of the kernels in the driver's cache, as far as is known.
    pub fn cached_kernels(&self) -> Vec<u64> {
        self.attached.as_ref().map(|attached| attached.gpu.cached_kernels()).unwrap_or_default()
    }

    /// Drops what the device keeps for later.
    pub fn trim(&self) {
        self.attached.iter().for_each(|attached| attached.gpu.trim());
    }

    /// The device with its painter.
    pub fn painter(&mut self) -> Option<(&Gpu, &mut Painter)> {
        self.attached.as_mut().map(|attached| (&*attached.gpu, &mut attached.painter))
    }

    /// Draws a painting on a target of `size` pixels. Without a target, only the painting's texture changes
    /// are applied.
    pub fn paint(&mut self, painting: &mut Painting, target: Option<&wgpu::TextureView>, size: [u32; 2]) {
        let Some((gpu, painter)) = self.painter().filter(|(gpu, _)| gpu.lost().is_none()) else {
            painting.textures.clear();
            return;
        };
        let painted = catch_unwind(AssertUnwindSafe(|| {
            painter.update(gpu, painting);
            if let Some(target) = target {
                painter.paint(gpu, painting, target, size);
            }
        }));
        // A device lost at this moment cannot map buffers for writing, which makes the overlay's renderer
        // panic.
        if let Err(panic) = painted
            && gpu.lost().is_none()
        {
            resume_unwind(panic);
        }
    }
}

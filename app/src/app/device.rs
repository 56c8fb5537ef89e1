//! The graphics device and what is made with it.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::Arc,
};

use glimpse::Gpu;

use crate::{Files, Painter, Painting, Wake, Worker};

/// After this many losses without a frame in between, a new device gets no worker: it shows the overlay only.
pub(crate) const MAX_LOSSES: u32 = 3;

/// The graphics device with its painter and its worker. There is none before the first [`DeviceState::attach`] and after
/// each [`DeviceState::detach`].
pub(crate) struct DeviceState {
    files: Files,
    wake: Wake,
    attached: Option<Attached>,
    /// Devices lost since the last frame arrived.
    losses: u32,
}

struct Attached {
    gpu: Arc<Gpu>,
    painter: Painter,
    /// `None` where no thread could be started, or after too many losses.
    worker: Option<Worker>,
    /// The worker has a scene and answers requests for frames.
    has_scene: bool,
}

impl DeviceState {
    /// Without a device. Workers read scenes through `files` and call `wake` when they have something to tell.
    pub fn new(files: Files, wake: Wake) -> Self {
        Self { files, wake, attached: None, losses: 0 }
    }

    /// Takes a device, to paint on targets of that format, with the overlay's `fonts` where the overlay has sent them before.
    ///
    /// # Errors
    /// No thread could be started for the worker; the device still paints.
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

    /// Drops a lost device and all that was made with it; returns how many were lost since the last frame.
    pub fn detach(&mut self) -> u32 {
        self.attached = None;
        self.losses += 1;
        self.losses
    }

    /// Why the device was lost, where that has happened.
    pub fn lost(&self) -> Option<&str> {
        self.attached.as_ref()?.gpu.lost()
    }

    /// There is a device.
    pub fn is_attached(&self) -> bool {
        self.attached.is_some()
    }

    /// The worker has loaded a scene.
    pub fn scene_opened(&mut self) {
        self.attached.iter_mut().for_each(|attached| attached.has_scene = true);
    }

    /// The worker can make frames.
    pub fn has_scene(&self) -> bool {
        self.attached.as_ref().is_some_and(|attached| attached.has_scene)
    }

    /// A frame arrived: the device works.
    pub fn frame_arrived(&mut self) {
        self.losses = 0;
    }

    /// The worker, with or without a scene.
    pub fn worker(&mut self) -> Option<&mut Worker> {
        self.attached.as_mut()?.worker.as_mut()
    }

    /// The worker, where it has a scene.
    pub fn ready_worker(&mut self) -> Option<&mut Worker> {
        if self.has_scene() { self.worker() } else { None }
    }

    /// The device and its painter.
    pub fn painter(&mut self) -> Option<(&Gpu, &mut Painter)> {
        self.attached.as_mut().map(|attached| (&*attached.gpu, &mut attached.painter))
    }

    /// Draws a painting on a target of `size` pixels. The painting's textures are taken over even where there is no target.
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
        // A device that is lost at this moment lends no memory to write to, which the overlay's renderer takes for a bug.
        if let Err(panic) = painted
            && gpu.lost().is_none()
        {
            resume_unwind(panic);
        }
    }
}

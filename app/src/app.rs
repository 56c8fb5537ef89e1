//! The program that a person sees: everything but the window.

mod clock;
mod delivery;
mod device;
mod pacing;
mod scene_list;
mod update;

use std::{path::PathBuf, sync::Arc, time::Duration};

use glimpse::Gpu;

pub(crate) use self::device::MAX_LOSSES;
pub use self::update::{Request, Update};
use self::{clock::Clock, delivery::Delivery, device::DeviceState, pacing::Pacing, scene_list::SceneList};
use crate::{
    CameraControl, Change, Choices, Files, FrameRate, Gestures, Job, Overlay, Painting, Quality, Readings,
    Wake, Worker, view::View,
};

/// The program.
pub struct App {
    pub(crate) context: egui::Context,
    pub(crate) choices: Choices,
    pub(crate) readings: Readings,
    pub(crate) scenes: SceneList,
    pub(crate) device: DeviceState,
    pub(crate) delivery: Delivery,
    pub(crate) pacing: Pacing,
    pub(crate) view: View,
    pub(crate) control: Option<CameraControl>,
    pub(crate) gestures: Gestures,
    pub(crate) requests: Vec<Request>,
    pub(crate) clock: Clock,
}

impl App {
    /// Without a device: nothing is shown before [`App::attach`]. `recent` are files that were opened before; the `scene` is
    /// opened as soon as there is a device.
    #[must_use]
    pub fn new(files: Files, wake: Wake, scene: &str, recent: Vec<String>, choices: Choices) -> Self {
        let context = egui::Context::default();
        // Gestures are read once a frame.
        context.options_mut(|options| options.max_passes = 1.try_into().unwrap_or(options.max_passes));
        Self {
            context,
            pacing: Pacing::new(&choices),
            choices,
            readings: Readings::default(),
            scenes: SceneList::new(scene, recent),
            device: DeviceState::new(files, wake),
            delivery: Delivery::default(),
            view: View::default(),
            control: None,
            gestures: Gestures::default(),
            requests: Vec::new(),
            clock: Clock::default(),
        }
    }

    /// The overlay's context, for shells that translate input.
    #[must_use]
    pub fn context(&self) -> &egui::Context {
        &self.context
    }

    /// The texture of the overlay's fonts as a whole, for a painter that begins late: the overlay sends what is new of it
    /// only. `None` before the first update, which sends it.
    #[must_use]
    pub fn fonts(&self) -> Option<egui::ColorImage> {
        (self.context.cumulative_pass_nr() > 0).then(|| self.context.fonts(|fonts| fonts.image()))
    }

    /// Takes a device, the first one or one in place of a lost one, to paint on targets of that format. What was shown comes
    /// back by itself.
    pub fn attach(&mut self, gpu: Arc<Gpu>, format: wgpu::TextureFormat) {
        let facts = gpu.facts();
        let on_cpu = facts.info.device_type == wgpu::DeviceType::Cpu;
        if self.readings.adapter.is_empty() && on_cpu && self.choices.governor == Choices::default().governor
        {
            self.choices.governor = Some(FrameRate::Fifteen);
        }
        self.readings.adapter = format!("{} ({})", facts.info.name, facts.info.driver_info);
        self.delivery = Delivery::default();
        if let Err(error) = self.device.attach(gpu, format, self.fonts()) {
            self.readings.problem = Some(format!("no thread to render with: {error}"));
        }
        let wanted = self.scenes.wanted().to_owned();
        self.load(&wanted);
    }

    /// Opens a scene; the one that is shown stays until it is there.
    pub fn open(&mut self, name: &str) {
        self.scenes.want(name);
        self.readings.problem = None;
        self.load(name);
    }

    pub(crate) fn load(&mut self, name: &str) {
        let Some(worker) = self.device.worker() else { return };
        worker.open(name);
        self.delivery.load_requested();
        self.clock.loading_began();
    }

    /// Lets time pass until `now`, hears what a person does and what the worker has done, orders what is to be made, and says
    /// what is to be shown.
    pub fn update(&mut self, input: egui::RawInput, now: Duration) -> Update {
        let passed = self.clock.advance(now);
        self.hear();
        // A view that rests orders nothing that would tell.
        if let Some(reason) = self.device.lost().map(str::to_owned) {
            self.lost(&reason);
        }
        self.view.touch |= input.events.iter().any(|event| matches!(event, egui::Event::Touch { .. }));
        if let Some(file) = input.dropped_files.first() {
            self.open(&file.path().to_string_lossy());
        }
        let context = self.context.clone();
        let mut wishes = Vec::new();
        let output = context.run_ui(input, |ui| wishes = self.show(ui, passed));
        for wish in wishes {
            self.grant(wish, &context);
        }
        self.order();
        let pixels_per_point = output.pixels_per_point;
        let delay = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        let delay = delay.unwrap_or(Duration::MAX);
        self.view.animated = delay.is_zero();
        Update {
            painting: Painting {
                jobs: context.tessellate(output.shapes, pixels_per_point),
                textures: output.textures_delta,
                pixels_per_point,
            },
            platform: output.platform_output,
            requests: std::mem::take(&mut self.requests),
            repaint_after: if self.is_live() { Duration::ZERO } else { delay },
        }
    }

    /// Puts a painting on a target of the device. The painting's textures are taken over even where there is no target.
    pub fn paint(&mut self, painting: &mut Painting, target: Option<&wgpu::TextureView>, size: [u32; 2]) {
        self.device.paint(painting, target, size);
    }

    /// Frames of a resting view have that many pixels, whatever the window has.
    pub fn set_view(&mut self, pixels: Option<[u32; 2]>) {
        self.view.frame_size = pixels;
    }

    /// Nobody sees the view from now on, or somebody does again: the frame of a resting view is not made meanwhile.
    pub fn set_hidden(&mut self, hidden: bool) {
        self.device.worker().into_iter().for_each(|worker| worker.set_hidden(hidden));
    }

    /// What is chosen.
    #[must_use]
    pub fn choices(&self) -> &Choices {
        &self.choices
    }

    /// What has been asked for since the last update.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    /// Makes a choice in words, as scripts do.
    ///
    /// # Errors
    /// What does not go with the other choices.
    pub fn change(&mut self, change: &Change) -> Result<(), String> {
        if matches!(change, Change::Governor(_)) {
            self.pacing.reset_tally();
        }
        change.apply(&mut self.choices)
    }

    /// Takes frames to need that many nanoseconds a pixel, whatever they took: what the governor does can be repeated then.
    pub fn set_cost(&mut self, nanoseconds: f64) {
        self.pacing.set_fixed_cost(nanoseconds);
    }

    /// The system is hot: a factor on the time that a frame may take, 1 when it is cool.
    pub fn set_thermal(&mut self, factor: f32) {
        self.pacing.set_thermal(factor);
    }

    /// A step back: closes what lies open above the picture; tells whether there was anything.
    pub fn back(&mut self) -> bool {
        let closed = self.readings.problem.take().is_some() || self.choices.help;
        self.choices.help = false;
        if !closed && self.choices.overlay == Overlay::Full {
            self.choices.overlay = Overlay::Brief;
            return true;
        }
        closed
    }

    /// Frames that were timed so far, and milliseconds of the last one.
    #[must_use]
    pub fn last_frame(&self) -> (u64, Option<f32>) {
        (self.pacing.frames(), self.readings.frame_ms.back().copied())
    }

    /// The scene that is shown, or that was asked for since.
    #[must_use]
    pub fn scene_wanted(&self) -> &str {
        self.scenes.wanted()
    }

    /// What went wrong and is being told.
    #[must_use]
    pub fn problem(&self) -> Option<&str> {
        self.readings.problem.as_deref()
    }

    /// The system wants memory back.
    pub fn trim(&mut self) {
        self.choices.split = None;
        self.pacing.trim();
    }

    /// Saves the frame, under that name or under one that the shell chooses.
    pub fn screenshot(&mut self, file: Option<PathBuf>) {
        if let (Some(job), Some(worker)) = (self.still_job(), self.device.ready_worker()) {
            worker.capture(job);
            self.delivery.capture_requested(file);
        } else {
            self.complain("There is no frame to save yet.".to_owned());
        }
    }

    /// Tells something that went well.
    pub fn notify(&mut self, text: String) {
        self.readings.notice = Some(text);
        self.clock.notice_began();
    }

    /// Tells something that went wrong.
    pub fn complain(&mut self, text: String) {
        self.readings.problem = Some(text);
    }

    /// Whether the view rests and its frame is complete.
    #[must_use]
    pub fn rests(&self) -> bool {
        let idle = !self.delivery.is_waiting() && !self.is_moving() && !self.view.animated;
        let complete = || self.delivery.is_complete(self.still_job().as_ref());
        idle && self.device.is_attached() && (!self.device.has_scene() || complete())
    }

    /// Waits until the worker has done what it was asked for.
    pub fn wait(&mut self) {
        while self.delivery.is_waiting() {
            let Some(news) = self.device.worker().and_then(Worker::wait) else { return };
            self.take(news);
        }
    }

    /// Something changes by itself.
    fn is_live(&self) -> bool {
        self.is_moving() || self.pacing.is_moving() && !self.delivery.is_frame_requested()
    }

    pub(crate) fn is_moving(&self) -> bool {
        self.control.as_ref().is_some_and(CameraControl::is_moving)
    }

    /// The frame of a view that rests: with everything as it was chosen.
    pub(crate) fn still_job(&self) -> Option<Job> {
        self.job(&self.pacing.quality_at_rest(&self.choices))
    }

    pub(crate) fn job(&self, quality: &Quality) -> Option<Job> {
        let camera = self.control.as_ref()?.camera();
        let size = self.readings.view.map(|side| quality.pixels(side));
        let settings = quality.settings(&self.choices.settings);
        Some(Job {
            camera,
            size,
            settings,
            show: self.choices.show,
            split: self.choices.split.is_some(),
            level: quality.level,
        })
    }
}

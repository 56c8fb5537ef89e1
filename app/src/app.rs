//! The application without its window.

mod clock;
mod delivery;
mod device;
mod file_name;
mod pacing;
mod scene_list;
mod update;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

use glimpse::Gpu;

pub use self::update::{Capture, Request, Update};
use self::{clock::Clock, delivery::Delivery, device::DeviceState, pacing::Pacing, scene_list::SceneList};
pub(crate) use self::{device::MAX_LOSSES, scene_list::short_name};
use crate::{
    CameraControl, Change, Choices, Files, FrameRate, Gestures, HudState, Job, Overlay, Painting, Quality,
    Wake, Worker, view::View,
};

/// The application: a shell calls [`App::update`] with input and time, and draws what that returns.
pub struct App {
    pub(crate) context: egui::Context,
    pub(crate) choices: Choices,
    pub(crate) hud_state: HudState,
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
    /// Creates the app without a device: it renders nothing before [`App::attach`]. `recent` are the names of
    /// recently opened files; `scene` is opened once a device is attached.
    #[must_use]
    pub fn new(files: Files, wake: Wake, scene: &str, recent: Vec<String>, choices: Choices) -> Self {
        let context = egui::Context::default();
        // Gestures are read once per update, so egui must not run a second pass within one.
        context.options_mut(|options| options.max_passes = 1.try_into().unwrap_or(options.max_passes));
        Self {
            context,
            pacing: Pacing::new(&choices),
            choices,
            hud_state: HudState::default(),
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

    /// The complete font texture of the overlay, for a painter created after the first update: later updates
    /// contain only its changes. `None` before the first update, which contains the complete texture.
    #[must_use]
    pub fn fonts(&self) -> Option<egui::ColorImage> {
        (self.context.cumulative_pass_nr() > 0).then(|| self.context.fonts(|fonts| fonts.image()))
    }

    /// Attaches a device, the first one or the replacement of a lost one, and the format of the render
    /// targets. Loads the scene onto it and requests its frame.
    pub fn attach(&mut self, gpu: Arc<Gpu>, format: wgpu::TextureFormat) {
        let facts = gpu.facts();
        let on_cpu = facts.info.device_type == wgpu::DeviceType::Cpu;
        if self.hud_state.adapter.is_empty() && on_cpu && self.choices.governor == Choices::default().governor
        {
            self.choices.governor = Some(FrameRate::Fifteen);
        }
        self.hud_state.adapter = format!("{} ({})", facts.info.name, facts.info.driver_info);
        self.delivery = Delivery::default();
        if let Err(error) = self.device.attach(gpu, format, self.fonts()) {
            self.hud_state.problem = Some(format!("no thread to render with: {error}"));
        }
        let wanted = self.scenes.wanted().to_owned();
        self.load(&wanted);
    }

    /// Opens a scene. The current one stays on screen until the new one is loaded.
    pub fn open(&mut self, name: &str) {
        self.scenes.want(name);
        (self.hud_state.problem, self.hud_state.folder) = (None, None);
        self.load(name);
    }

    pub(crate) fn load(&mut self, name: &str) {
        let Some(worker) = self.device.worker() else { return };
        worker.open(name);
        self.delivery.load_requested();
        self.clock.loading_began();
    }

    /// Opens the list of files, for systems without a file dialog: in the folder of the scene on display, or in the working
    /// folder where that is no file.
    pub fn browse(&mut self) {
        let file =
            self.scenes.shown().map(|scene| Self::file_path(&scene.name)).filter(|path| path.is_file());
        // The folder of a name without a folder is the empty path.
        let folder = file.as_deref().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
        self.list(folder.unwrap_or(Path::new(".")));
    }

    /// Reads a folder for the list of files.
    pub(crate) fn list(&mut self, folder: &Path) {
        if let Some(worker) = self.device.worker() {
            let number = worker.list(folder);
            self.delivery.listing_requested(number);
        }
    }

    /// Advances the app to the time `now`: handles messages of the worker and input, moves the camera,
    /// requests the next frame, and returns what to show. `now` is measured from an arbitrary fixed moment
    /// and never decreases.
    pub fn update(&mut self, mut input: egui::RawInput, now: Duration) -> Update {
        let passed = self.clock.advance(now);
        self.poll_worker();
        // A view at rest requests no frames, so the worker would not notice a lost device: the app checks it
        // here.
        if let Some(reason) = self.device.lost().map(str::to_owned) {
            self.lost(&reason);
        }
        input.events = self.view.input.next(input.events);
        self.view.touch |= input.events.iter().any(|event| matches!(event, egui::Event::Touch { .. }));
        if let Some(file) = input.dropped_files.first() {
            self.open(&Self::file_name(file.path()));
        }
        let context = self.context.clone();
        let mut user_requests = Vec::new();
        let output = context.run_ui(input, |ui| user_requests = self.show(ui, passed));
        for request in user_requests {
            self.handle_request(request, &context);
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

    /// Draws a painting on a target of `size` pixels. Without a target, only the painting's texture changes
    /// are applied.
    pub fn paint(&mut self, painting: &mut Painting, target: Option<&wgpu::TextureView>, size: [u32; 2]) {
        self.device.paint(painting, target, size);
    }

    /// Sets the size of frames at full resolution in pixels; `None` for the window's size.
    pub fn set_view(&mut self, pixels: Option<[u32; 2]>) {
        self.view.frame_size = pixels;
    }

    /// Sets whether the view is hidden: while it is, no frames at rest are rendered.
    pub fn set_hidden(&mut self, hidden: bool) {
        self.device.worker().into_iter().for_each(|worker| worker.set_hidden(hidden));
    }

    /// Current choices.
    #[must_use]
    pub fn choices(&self) -> &Choices {
        &self.choices
    }

    /// Takes the requests to the shell that were made since the last update.
    pub fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.requests)
    }

    /// Applies one change of the choices.
    ///
    /// # Errors
    /// Fails if the value is invalid together with the other choices.
    pub fn change(&mut self, change: &Change) -> Result<(), String> {
        if matches!(change, Change::Governor(_)) {
            self.pacing.reset_tally();
        }
        change.apply(&mut self.choices)
    }

    /// Replaces measured frame times by a fixed cost in nanoseconds per pixel, which makes the governor's
    /// behaviour reproducible.
    pub fn set_cost(&mut self, nanoseconds: f64) {
        self.pacing.set_fixed_cost(nanoseconds);
    }

    /// Sets a factor on the governor's frame time, 1 while the device is cool.
    pub fn set_thermal(&mut self, factor: f32) {
        self.pacing.set_thermal(factor);
    }

    /// Closes the error message, the list of files and the help, or reduces the full overlay to the brief one; returns
    /// false if none was open.
    pub fn back(&mut self) -> bool {
        let closed = self.hud_state.problem.take().is_some() | self.hud_state.folder.take().is_some();
        let closed = closed || self.choices.help;
        self.choices.help = false;
        if !closed && self.choices.overlay == Overlay::Full {
            self.choices.overlay = Overlay::Brief;
            return true;
        }
        closed
    }

    /// The number of timed frames so far, and the time of the last one in milliseconds.
    #[must_use]
    pub fn last_frame(&self) -> (u64, Option<f32>) {
        (self.pacing.frames(), self.hud_state.frame_ms.back().copied())
    }

    /// Name of the scene that was requested last, or of the current one if that request failed.
    #[must_use]
    pub fn scene_wanted(&self) -> &str {
        self.scenes.wanted()
    }

    /// Title for the window: `helmet.glb - Glimpse`.
    #[must_use]
    pub fn title(&self) -> String {
        self.scenes.title()
    }

    /// The error message on display.
    #[must_use]
    pub fn problem(&self) -> Option<&str> {
        self.hud_state.problem.as_deref()
    }

    /// Fingerprints of the kernels in the driver's cache, for [`Gpu::add_cached_kernels`] in a later run.
    #[must_use]
    pub fn cached_kernels(&self) -> Vec<u64> {
        self.device.cached_kernels()
    }

    /// Reduces the use of memory: ends the split view and lowers the governor's resolution.
    pub fn trim(&mut self) {
        self.choices.split = None;
        self.pacing.trim();
        self.device.trim();
    }

    /// Saves the current frame under that name; with `None` the shell chooses a name.
    pub fn screenshot(&mut self, file: Option<PathBuf>) {
        if !self.capture(Capture::Save(file)) {
            self.report_problem("There is no frame to save yet.".to_owned());
        }
    }

    /// Has the current frame compared with a file, within bounds as they are typed; returns false where there is no frame
    /// yet.
    pub fn compare(&mut self, file: PathBuf, bounds: String) -> bool {
        self.capture(Capture::Compare(file, bounds))
    }

    /// Requests a picture of the current frame; returns false where there is none yet.
    fn capture(&mut self, capture: Capture) -> bool {
        let (Some(job), Some(worker)) = (self.still_job(), self.device.ready_worker()) else { return false };
        worker.capture(job);
        self.delivery.capture_requested(capture);
        true
    }

    /// Shows a confirmation for a few seconds.
    pub fn notify(&mut self, text: String) {
        self.hud_state.notice = Some(text);
        self.clock.notice_began();
    }

    /// Shows an error message until it is closed.
    pub fn report_problem(&mut self, text: String) {
        self.hud_state.problem = Some(text);
    }

    /// Whether the camera is still, the overlay is not animated, all requests are answered, and the frame at
    /// rest is shown or has failed.
    #[must_use]
    pub fn rests(&self) -> bool {
        let idle = !self.delivery.is_waiting() && !self.view.input.is_waiting();
        let idle = idle && !self.is_moving() && !self.view.animated;
        let complete = || self.delivery.is_complete(self.still_job().as_ref());
        idle && self.device.is_attached() && (!self.device.has_scene() || complete())
    }

    /// Waits until the worker has answered all requests.
    pub fn wait(&mut self) {
        while self.delivery.is_waiting() {
            let Some(event) = self.device.worker().and_then(Worker::wait) else { return };
            self.take(event);
        }
    }

    /// Whether the picture changes without input, so that updates must follow each other without a pause.
    fn is_live(&self) -> bool {
        self.is_moving()
            || self.view.input.is_waiting()
            || self.pacing.is_moving() && !self.delivery.is_frame_requested()
    }

    pub(crate) fn is_moving(&self) -> bool {
        self.control.as_ref().is_some_and(CameraControl::is_moving)
    }

    /// Job of the last frame of a view at rest.
    pub(crate) fn still_job(&self) -> Option<Job> {
        let chosen = self.job(&self.pacing.quality_at_rest(&self.choices))?;
        Some(match self.choices.refined() {
            Some(settings) => Job { settings, is_refined: true, ..chosen },
            None => chosen,
        })
    }

    /// Job of the next frame of that quality: at rest that of the chosen frame until it is shown and counted, then that of
    /// the refined one.
    pub(crate) fn next_job(&self, quality: &Quality) -> Option<Job> {
        let chosen = self.job(quality)?;
        if !chosen.is_still() {
            return Some(chosen);
        }
        let last = self.still_job()?;
        let has_begun = self.delivery.is_complete(Some(&last)) || self.delivery.is_requested(&last);
        let is_chosen_done = self.delivery.is_complete(Some(&chosen)) && !self.delivery.is_counting();
        Some(if has_begun || is_chosen_done { last } else { chosen })
    }

    pub(crate) fn job(&self, quality: &Quality) -> Option<Job> {
        let camera = self.control.as_ref()?.camera();
        let size = self.hud_state.view.map(|side| quality.pixels(side));
        let settings = quality.settings(&self.choices.settings);
        Some(Job {
            camera,
            size,
            settings,
            show: self.choices.show,
            split: self.choices.split.is_some(),
            level: quality.level,
            is_refined: false,
        })
    }
}

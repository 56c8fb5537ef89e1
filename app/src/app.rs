//! The program that a person sees: everything but the window.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    path::PathBuf,
    sync::Arc,
    time::Duration,
};

use glimpse::{DisplayImage, Gpu};

use crate::{
    CameraControl, Change, Choices, Files, Frame, FrameRate, FrameReport, Gestures, Governor, Job, Overlay,
    Painter, Painting, Quality, Readings, SceneFacts, Wake, Worker,
};

/// Scenes from files that are remembered.
pub const MOST_RECENT: usize = 8;

/// A notice is told for so long.
const NOTICE: Duration = Duration::from_secs(4);

/// A device that is lost so often without a frame between is not made again.
pub(crate) const LOSSES: u32 = 3;

/// What the shell is asked for.
#[derive(Debug)]
pub enum Request {
    /// To let a person choose a file, for [`App::open`].
    OpenDialog,
    /// To save a picture, under that name or under one of its own.
    Save(Option<PathBuf>, DisplayImage),
    /// To remember the scenes that were opened last.
    Remember(Vec<String>),
    /// The window as large as the screen, or not.
    FullScreen,
    /// The device is lost: to [`App::attach`] a new one.
    NewDevice,
    /// The end.
    Quit,
}

/// What comes of an update.
pub struct Update {
    /// What is to be shown.
    pub painting: Painting,
    /// Clipboard, pointer, text input.
    pub platform: egui::PlatformOutput,
    /// What else is to be done.
    pub requests: Vec<Request>,
    /// When the next update is due at the latest; news and input may come before.
    pub repaint_after: Duration,
}

/// The program.
pub struct App {
    pub(crate) context: egui::Context,
    files: Files,
    wake: Wake,
    pub(crate) choices: Choices,
    pub(crate) readings: Readings,
    pub(crate) scenes: Vec<String>,
    recent: Vec<String>,
    pub(crate) device: Option<Device>,
    /// The scene that is shown.
    pub(crate) scene: Option<SceneFacts>,
    /// The one that was asked for last.
    pub(crate) wanted: String,
    pub(crate) control: Option<CameraControl>,
    pub(crate) gestures: Gestures,
    pub(crate) governor: Governor,
    /// Of the frame that was ordered last.
    pub(crate) quality: Quality,
    /// What the governor has not been told.
    pub(crate) report: Option<FrameReport>,
    /// Pixels of the view, where they are not the window's.
    pub(crate) view: Option<[u32; 2]>,
    /// Pixels of the screen that the picture takes.
    pub(crate) picture: [u32; 2],
    pub(crate) shown: Option<Shown>,
    pub(crate) pending: Pending,
    pub(crate) requests: Vec<Request>,
    pub(crate) now: Duration,
    pub(crate) notice_until: Duration,
    pub(crate) busy_since: Duration,
    pub(crate) touch: bool,
    /// The overlay is not done with what it fades or moves.
    animated: bool,
    /// Nanoseconds a pixel that frames are taken to need.
    pub(crate) cost: Option<f64>,
    pub(crate) losses: u32,
    pub(crate) tally: Tally,
    /// Frames that were timed.
    pub(crate) frames: u64,
}

/// Frames since the governor was chosen last.
#[derive(Default)]
pub(crate) struct Tally {
    /// Those of a view that moves.
    pub frames: u32,
    /// Those of them that took longer than they may.
    pub late: u32,
}

/// A device and what was made with it.
pub(crate) struct Device {
    pub gpu: Arc<Gpu>,
    pub painter: Painter,
    pub worker: Option<Worker>,
    /// The worker has a scene: what it is asked for will be answered.
    pub ready: bool,
}

impl Device {
    /// The worker, where it has a scene.
    pub fn ready_worker(&mut self) -> Option<&mut Worker> {
        self.worker.as_mut().filter(|_| self.ready)
    }
}

/// The frame that is shown, as textures of the overlay.
pub(crate) struct Shown {
    pub frame: Box<Frame>,
    pub picture: egui::TextureId,
    pub full: Option<egui::TextureId>,
    /// Pixels are repeated, not interpolated.
    pub exact: bool,
}

/// A frame that was ordered.
pub(crate) struct Ordered {
    pub number: u64,
    pub job: Job,
}

/// What the worker has not answered.
#[derive(Default)]
pub(crate) struct Pending {
    pub load: bool,
    pub frame: Option<Ordered>,
    /// The one that could not be made: it is not tried again.
    pub vain: Option<Job>,
    pub count: Option<u64>,
    /// Where the picture goes.
    pub capture: Option<Option<PathBuf>>,
    pub pick: bool,
}

impl App {
    /// Without a device: nothing is shown before [`App::attach`]. `recent` are files that were opened before; the `scene` is
    /// opened as soon as there is a device.
    #[must_use]
    pub fn new(files: Files, wake: Wake, scene: &str, recent: Vec<String>, choices: Choices) -> Self {
        let context = egui::Context::default();
        // Gestures are read once a frame.
        context.options_mut(|options| options.max_passes = 1.try_into().unwrap_or(options.max_passes));
        let mut app = Self {
            context,
            files,
            wake,
            governor: Governor::new(choices.governor.unwrap_or(FrameRate::Thirty).budget_ms()),
            choices,
            readings: Readings::default(),
            scenes: Vec::new(),
            recent,
            device: None,
            scene: None,
            wanted: scene.to_owned(),
            control: None,
            gestures: Gestures::default(),
            quality: Quality::FULL,
            report: None,
            view: None,
            picture: [0, 0],
            shown: None,
            pending: Pending::default(),
            requests: Vec::new(),
            now: Duration::ZERO,
            notice_until: Duration::ZERO,
            busy_since: Duration::ZERO,
            touch: false,
            animated: false,
            cost: None,
            losses: 0,
            tally: Tally::default(),
            frames: 0,
        };
        app.list_scenes();
        app
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
        self.shown = None;
        self.pending = Pending::default();
        let mut painter = Painter::new(&gpu, format);
        self.fonts().into_iter().for_each(|image| painter.load_fonts(&gpu, image));
        let worker = if self.losses < LOSSES {
            Worker::start(gpu.clone(), self.files.clone(), self.wake.clone())
                .map_err(|error| self.readings.problem = Some(format!("no thread to render with: {error}")))
                .ok()
        } else {
            None
        };
        self.device = Some(Device { gpu, painter, worker, ready: false });
        let wanted = self.wanted.clone();
        self.load(&wanted);
    }

    /// Opens a scene; the one that is shown stays until it is there.
    pub fn open(&mut self, name: &str) {
        self.wanted = name.to_owned();
        self.readings.problem = None;
        self.load(name);
    }

    pub(crate) fn load(&mut self, name: &str) {
        let Some(worker) = self.device.as_mut().and_then(|device| device.worker.as_mut()) else { return };
        worker.open(name);
        self.pending.load = true;
        self.busy_since = self.now;
    }

    /// Lets time pass until `now`, hears what a person does and what the worker has done, orders what is to be made, and says
    /// what is to be shown.
    pub fn update(&mut self, input: egui::RawInput, now: Duration) -> Update {
        let passed = now.saturating_sub(self.now);
        self.now = now;
        self.hear();
        // A view that rests orders nothing that would tell.
        if let Some(reason) = self.device.as_ref().and_then(|device| device.gpu.lost()).map(str::to_owned) {
            self.lost(&reason);
        }
        self.touch |= input.events.iter().any(|event| matches!(event, egui::Event::Touch { .. }));
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
        self.animated = delay.is_zero();
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
        let Some(Device { gpu, painter, .. }) = &mut self.device else {
            painting.textures.clear();
            return;
        };
        if gpu.lost().is_some() {
            painting.textures.clear();
            return;
        }
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

    /// Frames of a resting view have that many pixels, whatever the window has.
    pub fn set_view(&mut self, pixels: Option<[u32; 2]>) {
        self.view = pixels;
    }

    /// Nobody sees the view from now on, or somebody does again: the frame of a resting view is not made meanwhile.
    pub fn set_hidden(&mut self, hidden: bool) {
        self.worker().into_iter().for_each(|worker| worker.set_hidden(hidden));
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
            self.tally = Tally::default();
        }
        change.apply(&mut self.choices)
    }

    /// Takes frames to need that many nanoseconds a pixel, whatever they took: what the governor does can be repeated then.
    pub fn set_cost(&mut self, nanoseconds: f64) {
        self.cost = Some(nanoseconds);
    }

    /// The system is hot: a factor on the time that a frame may take, 1 when it is cool.
    pub fn set_thermal(&mut self, factor: f32) {
        self.governor.set_thermal(factor);
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
        (self.frames, self.readings.frame_ms.back().copied())
    }

    /// The scene that is shown, or that was asked for since.
    #[must_use]
    pub fn scene_wanted(&self) -> &str {
        &self.wanted
    }

    /// What went wrong and is being told.
    #[must_use]
    pub fn problem(&self) -> Option<&str> {
        self.readings.problem.as_deref()
    }

    /// The system wants memory back.
    pub fn trim(&mut self) {
        self.choices.split = None;
        self.governor.trim();
    }

    /// Saves the frame, under that name or under one that the shell chooses.
    pub fn screenshot(&mut self, file: Option<PathBuf>) {
        if let (Some(job), Some(worker)) = (self.still_job(), self.ready_worker()) {
            worker.capture(job);
            self.pending.capture = Some(file);
        } else {
            self.complain("There is no frame to save yet.".to_owned());
        }
    }

    /// Tells something that went well.
    pub fn notify(&mut self, text: String) {
        self.readings.notice = Some(text);
        self.notice_until = self.now + NOTICE;
    }

    /// Tells something that went wrong.
    pub fn complain(&mut self, text: String) {
        self.readings.problem = Some(text);
    }

    /// Whether the view rests and its frame is complete.
    #[must_use]
    pub fn rests(&self) -> bool {
        let idle = !self.is_waiting() && !self.is_moving() && !self.animated;
        idle && self.device.as_ref().is_some_and(|device| !device.ready || self.is_complete())
    }

    /// The frame of a view that rests is shown, or cannot be made.
    fn is_complete(&self) -> bool {
        let job = self.still_job();
        job.as_ref().is_some_and(|job| self.is_shown(job)) || job == self.pending.vain
    }

    /// The job's frame is shown, and another would be the same.
    pub(crate) fn is_shown(&self, job: &Job) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.frame.job == *job && shown.frame.settled)
    }

    /// Waits until the worker has done what it was asked for.
    pub fn wait(&mut self) {
        while self.is_waiting() {
            let Some(news) = self.worker().and_then(Worker::wait) else { return };
            self.take(news);
        }
    }

    fn is_waiting(&self) -> bool {
        let Pending { load, frame, count, capture, pick, vain: _ } = &self.pending;
        *load || frame.is_some() || count.is_some() || capture.is_some() || *pick
    }

    /// Something changes by itself.
    fn is_live(&self) -> bool {
        self.is_moving() || self.quality.level.is_some() && self.pending.frame.is_none()
    }

    pub(crate) fn is_moving(&self) -> bool {
        self.control.as_ref().is_some_and(CameraControl::is_moving)
    }

    /// The frame of a view that rests: with everything as it was chosen.
    pub(crate) fn still_job(&self) -> Option<Job> {
        self.job(&self.still_quality())
    }

    pub(crate) fn still_quality(&self) -> Quality {
        let scale =
            if self.choices.governed().is_some() { self.governor.largest() } else { self.choices.scale };
        Quality { scale, ..Quality::FULL }
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

    pub(crate) fn worker(&mut self) -> Option<&mut Worker> {
        self.device.as_mut()?.worker.as_mut()
    }

    /// The worker, where it has a scene.
    pub(crate) fn ready_worker(&mut self) -> Option<&mut Worker> {
        self.device.as_mut()?.ready_worker()
    }

    /// The scene is shown: it is offered again.
    pub(crate) fn remember(&mut self, name: &str) {
        if name.starts_with("builtin:") {
            return;
        }
        self.recent.retain(|known| known != name);
        self.recent.insert(0, name.to_owned());
        self.recent.truncate(MOST_RECENT);
        self.requests.push(Request::Remember(self.recent.clone()));
        self.list_scenes();
    }

    fn list_scenes(&mut self) {
        self.scenes = crate::scenes().chain(self.recent.iter().cloned()).collect();
    }
}

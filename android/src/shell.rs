//! The activity's shell: passes the system's events to the session, and presents its frames in the window.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use android_activity::{AndroidApp, MainEvent, PollEvent};
use glimpse::Gpu;
use glimpse_app::Painting;
use glimpse_shell::{Leftover, RETRY, Session, Shown, Surface};
use ndk::native_window::NativeWindow;

use crate::{
    canvas::Canvas,
    compiled,
    feedback::Feedback,
    files::Names,
    input::Input,
    insets::Insets,
    intent_extras,
    java::{self, Intent},
    lend, screen,
};

/// Size of frames at full resolution in pixels, in landscape, on any display.
const QHD: [u32; 2] = [2560, 1440];

/// State of the activity.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Lifecycle {
    Runs,
    /// Its user has left it.
    Finished,
    Destroyed,
}

/// The session of an activity, its window and its device.
pub struct Shell {
    android: AndroidApp,
    session: Session,
    instance: wgpu::Instance,
    gpu: Option<Arc<Gpu>>,
    surface: Option<Surface>,
    /// Draws the overlay where there is no device.
    canvas: Option<Canvas>,
    input: Input,
    insets: Insets,
    feedback: Feedback,
    /// When the next frame is due, without an event; `None` for never.
    due: Option<Instant>,
    /// The activity has not been resumed yet.
    fresh: bool,
    lifecycle: Lifecycle,
}

impl Shell {
    /// Reads the intent and creates the session. There is no window yet.
    pub fn new(android: AndroidApp) -> Self {
        let names = Names::default();
        let intent = java::intent(&android);
        let (intent, mut problem) = match intent {
            Ok(intent) => (intent, None),
            Err(reason) => (Intent::default(), Some(format!("the intent cannot be read: {reason}"))),
        };
        let view = intent.view.as_deref().map_or(Ok(QHD), intent_extras::pixels);
        let view = view.unwrap_or_else(|line| {
            problem.get_or_insert(line);
            QHD
        });
        let setup = lend::setup(&android, &names, &intent, view);
        let waker = android.create_waker();
        let mut session = Session::new(setup, Arc::new(move || waker.wake()));
        if let Some(words) = &intent.set
            && let Err(line) = intent_extras::choose(&mut session.app, words)
        {
            problem.get_or_insert(line);
        }
        problem.into_iter().for_each(|line| session.app.report_problem(line));
        Self {
            android,
            session,
            instance: glimpse::instance(),
            gpu: None,
            surface: None,
            canvas: None,
            input: Input::default(),
            insets: Insets::default(),
            feedback: Feedback::new(),
            due: None,
            fresh: true,
            lifecycle: Lifecycle::Runs,
        }
    }

    /// State of the activity; the main loop ends when it is not [`Lifecycle::Runs`].
    pub fn lifecycle(&self) -> Lifecycle {
        self.lifecycle
    }

    /// How long to wait for an event; `None` for any time.
    pub fn poll_timeout(&self) -> Option<Duration> {
        self.android.native_window()?;
        self.due.map(|due| due.saturating_duration_since(Instant::now()))
    }

    /// Handles an event of the activity.
    pub fn handle_event(&mut self, event: PollEvent<'_>) {
        let PollEvent::Main(event) = event else { return };
        match event {
            MainEvent::InitWindow { .. } => {
                self.insets.request(&self.android);
                self.session.app.set_hidden(false);
                self.make_surface();
            }
            MainEvent::TerminateWindow { .. } => {
                // First, because dropping the surface waits for the device, and hidden frames are cancelled.
                self.session.app.set_hidden(true);
                self.surface = None;
            }
            MainEvent::WindowResized { .. }
            | MainEvent::ContentRectChanged { .. }
            | MainEvent::ConfigChanged { .. }
            | MainEvent::InsetsChanged { .. }
            | MainEvent::GainedFocus => self.insets.request(&self.android),
            MainEvent::Resume { loader, .. } => {
                // The state was saved by an activity before this one. Android also delivers what this one saved itself,
                // which may be outdated when it resumes again.
                let saved = if self.fresh { loader.load() } else { None };
                self.fresh = false;
                if let Some(scene) = saved.and_then(|state| String::from_utf8(state).ok())
                    && self.session.app.scene_wanted() != scene
                {
                    self.session.app.open(&scene);
                }
            }
            MainEvent::SaveState { saver, .. } => saver.store(self.session.app.scene_wanted().as_bytes()),
            MainEvent::Pause => self.keep_compiled(),
            MainEvent::LowMemory => self.session.app.trim(),
            MainEvent::Destroy => self.lifecycle = Lifecycle::Destroyed,
            _ => {}
        }
    }

    /// Creates a surface for the window, and a device that supports it where there is none. Where that fails, the
    /// overlay shows the reason, drawn in software.
    fn make_surface(&mut self) {
        self.surface = None;
        let Some(window) = self.android.native_window() else { return };
        match self.surface_of(window) {
            Ok(surface) => {
                self.surface = Some(surface);
                self.canvas = None;
            }
            Err(line) => {
                self.session.app.report_problem(line);
                self.gpu = None;
                let mut canvas = Canvas::default();
                self.session.app.fonts().into_iter().for_each(|image| canvas.load_fonts(image));
                self.canvas = Some(canvas);
            }
        }
    }

    fn surface_of(&mut self, window: NativeWindow) -> Result<Surface, String> {
        let size = screen::pixels(&window);
        let surface = screen::surface(&self.instance, window)?;
        let known = self.gpu.clone();
        let gpu = match &known {
            Some(gpu) => gpu.clone(),
            None => {
                let gpu =
                    Gpu::for_surface(&self.instance, None, Some(&surface), None).map_err(screen::refusal)?;
                let folder = self.android.internal_data_path();
                Arc::new(compiled::with_compiled(gpu, folder.as_deref()))
            }
        };
        let surface = Surface::new(surface, &gpu, size, self.session.app.choices().vsync)?;
        if known.is_none() {
            self.session.attach(&gpu, surface.format());
            self.gpu = Some(gpu);
        }
        Ok(surface)
    }

    /// Updates the session with the events that have arrived, and presents its frame.
    pub fn frame(&mut self) {
        let scale = self.pixels_per_point();
        self.input.read(&self.android, scale);
        for _ in 0..self.input.take_backs() {
            if !self.session.app.back() {
                self.lifecycle = Lifecycle::Finished;
            }
        }
        let Some(window) = self.android.native_window() else { return };
        if let Some(share) = self.feedback.thermal_share(Instant::now()) {
            self.session.app.set_thermal(share);
        }
        let size = screen::pixels(&window);
        if let Some(surface) = &mut self.surface {
            surface.follow(size, self.session.app.choices().vsync);
        }
        let input = egui::RawInput {
            events: self.input.take(),
            safe_area_insets: Some(self.insets.safe_area(scale)),
            ..egui::RawInput::default()
        };
        // Only a script makes this fail, and none is played here.
        let Ok((mut update, leftover)) = self.session.frame(input, size, scale) else { return };
        for command in &update.platform.commands {
            if let egui::OutputCommand::CopyText(text) = command {
                self.copy(text.clone());
            }
        }
        let shown = self.show(&mut update.painting, &window);
        let rest = if shown == Shown::NotNow { RETRY } else { update.repaint_after };
        self.due = Instant::now().checked_add(rest);
        self.follow(leftover);
        self.feedback.tell(&self.android, &self.session.app, self.surface.is_some());
    }

    fn show(&mut self, painting: &mut Painting, window: &NativeWindow) -> Shown {
        let Some(canvas) = &mut self.canvas else {
            // Only saving the window's content makes this fail, which only scripts request.
            let shown = self.session.show(painting, self.surface.as_mut()).unwrap_or(Shown::NotNow);
            if shown == Shown::Lost {
                self.make_surface();
                return Shown::NotNow;
            }
            return shown;
        };
        canvas.update(std::mem::take(&mut painting.textures));
        let size = screen::pixels(window).map(|side| side as usize);
        let picture = canvas.paint(&painting.jobs, painting.pixels_per_point, size);
        if let Err(error) = screen::post(window, &picture) {
            log::warn!("nothing can be shown: {error}");
        }
        Shown::Yes
    }

    fn follow(&mut self, leftover: Leftover) {
        if leftover.dialog {
            let hint = "Open a .glb file in the file manager with Glimpse, or share it to Glimpse.";
            self.session.app.notify(hint.to_owned());
        }
        if leftover.new_device {
            self.gpu = None;
            self.make_surface();
        }
        if leftover.quit {
            self.lifecycle = Lifecycle::Finished;
        }
    }

    fn copy(&self, text: String) {
        java::on_main_thread(&self.android, move |android| {
            if let Err(reason) = java::copy(android, &text) {
                log::warn!("the clipboard takes nothing: {reason}");
            }
        });
    }

    fn keep_compiled(&self) {
        let (Some(gpu), Some(folder)) = (&self.gpu, self.android.internal_data_path()) else { return };
        if let Err(error) = compiled::keep(gpu, &folder) {
            log::warn!("what was compiled is not kept: {error}");
        }
    }

    fn pixels_per_point(&self) -> f32 {
        self.android.config().density().unwrap_or(160) as f32 / 160.0
    }
}

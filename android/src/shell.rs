//! The activity: what the system tells to the session, and the session's pictures to the window.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

use android_activity::{AndroidApp, AndroidAppWaker, MainEvent, PollEvent, WindowManagerFlags, input::Axis};
use egui::epaint::MarginF32;
use glimpse::Gpu;
use glimpse_app::Painting;
use glimpse_shell::{Leftover, RETRY, Session, Shown, Surface};
use ndk::native_window::NativeWindow;

use crate::{
    canvas::Canvas,
    compiled,
    files::Names,
    input::Input,
    java::{self, Intent},
    lend,
    pace::{self, Hints, Thermometer},
    screen, wishes,
};

/// Pixels of the frame of a view that rests, in landscape, on whatever display.
const QHD: [u32; 2] = [2560, 1440];

/// The activity that shows pictures now: an older one of the same process leaves when a new one begins.
static CURRENT: Mutex<Option<Arc<Leave>>> = Mutex::new(None);

/// Asks an activity to leave, from any thread.
struct Leave {
    asked: AtomicBool,
    waker: AndroidAppWaker,
}

/// Runs until the activity is destroyed or a person has enough of it.
pub fn run(android: &AndroidApp) {
    let leave = Arc::new(Leave { asked: AtomicBool::new(false), waker: android.create_waker() });
    if let Some(older) = current().replace(leave.clone()) {
        older.asked.store(true, Ordering::Release);
        older.waker.wake();
    }
    android.enable_motion_axis(Axis::Vscroll);
    android.enable_motion_axis(Axis::Hscroll);
    let mut shell = Shell::new(android.clone());
    while shell.stage == Stage::Runs && !leave.asked.load(Ordering::Acquire) {
        android.poll_events(shell.patience(), |event| shell.hear(event));
        // Whatever came may have changed the picture.
        if shell.stage == Stage::Runs {
            shell.frame();
        }
    }
    current().take_if(|newest| Arc::ptr_eq(newest, &leave));
    let mut destroyed = shell.stage == Stage::Destroyed;
    drop(shell);
    if !destroyed {
        java::on_main_thread(android, |android| {
            java::finish(android).unwrap_or_else(|reason| log::warn!("the activity stays: {reason}"));
        });
    }
    // What returns before is never told, and android_activity keeps its files open then.
    while !destroyed {
        android.poll_events(None, |event| {
            destroyed |= matches!(event, PollEvent::Main(MainEvent::Destroy));
        });
    }
}

/// Where the life of an activity is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Stage {
    Runs,
    /// A person has enough of it.
    Enough,
    Destroyed,
}

fn current() -> std::sync::MutexGuard<'static, Option<Arc<Leave>>> {
    CURRENT.lock().unwrap_or_else(PoisonError::into_inner)
}

struct Shell {
    android: AndroidApp,
    session: Session,
    instance: wgpu::Instance,
    gpu: Option<Arc<Gpu>>,
    surface: Option<Surface>,
    /// What the overlay is painted on where there is no device.
    canvas: Option<Canvas>,
    input: Input,
    /// Pixels at the left, top, right and bottom that the screen's shape takes; told by Java's main thread.
    insets: Arc<Mutex<[i32; 4]>>,
    thermometer: Option<Thermometer>,
    /// As the system gave them when it was asked: once, when there are threads that make frames.
    hints: Option<Option<Hints>>,
    /// When the next frame is due.
    due: Option<Instant>,
    /// The screen does not go dark.
    kept_on: bool,
    /// The problem that was logged last.
    logged: Option<String>,
    /// It has not been resumed yet.
    fresh: bool,
    stage: Stage,
}

impl Shell {
    fn new(android: AndroidApp) -> Self {
        let names = Names::default();
        let intent = java::intent(&android);
        let (intent, mut problem) = match intent {
            Ok(intent) => (intent, None),
            Err(reason) => (Intent::default(), Some(format!("the intent cannot be read: {reason}"))),
        };
        let view = intent.view.as_deref().map_or(Ok(QHD), wishes::pixels);
        let view = view.unwrap_or_else(|line| {
            problem.get_or_insert(line);
            QHD
        });
        let setup = lend::setup(&android, &names, &intent, view);
        let waker = android.create_waker();
        let mut session = Session::new(setup, Arc::new(move || waker.wake()));
        if let Some(words) = &intent.set
            && let Err(line) = wishes::choose(&mut session.app, words)
        {
            problem.get_or_insert(line);
        }
        problem.into_iter().for_each(|line| session.app.complain(line));
        Self {
            android,
            session,
            instance: glimpse::instance(),
            gpu: None,
            surface: None,
            canvas: None,
            input: Input::default(),
            insets: Arc::default(),
            thermometer: Thermometer::new(),
            hints: None,
            due: None,
            kept_on: false,
            logged: None,
            fresh: true,
            stage: Stage::Runs,
        }
    }

    /// How long there is nothing to do unless something comes; `None` is for ever.
    fn patience(&self) -> Option<Duration> {
        self.android.native_window()?;
        self.due.map(|due| due.saturating_duration_since(Instant::now()))
    }

    fn hear(&mut self, event: PollEvent<'_>) {
        let PollEvent::Main(event) = event else { return };
        match event {
            MainEvent::InitWindow { .. } => {
                self.immerse();
                self.session.app.set_hidden(false);
                self.make_surface();
            }
            MainEvent::TerminateWindow { .. } => {
                // Before the surface, which waits for what the device is doing.
                self.session.app.set_hidden(true);
                self.surface = None;
            }
            MainEvent::WindowResized { .. }
            | MainEvent::ContentRectChanged { .. }
            | MainEvent::ConfigChanged { .. }
            | MainEvent::InsetsChanged { .. }
            | MainEvent::GainedFocus => self.immerse(),
            MainEvent::Resume { loader, .. } => {
                // Of an activity before this one; what this one saves itself comes back too, and may be old by then.
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
            MainEvent::Destroy => self.stage = Stage::Destroyed,
            _ => {}
        }
    }

    /// Hides the bars and asks for the insets, on the thread that may.
    fn immerse(&self) {
        let (insets, waker) = (self.insets.clone(), self.android.create_waker());
        java::on_main_thread(&self.android, move |android| match java::immerse(android) {
            Ok(told) => {
                *insets.lock().unwrap_or_else(PoisonError::into_inner) = told;
                waker.wake();
            }
            Err(reason) => log::warn!("the system's bars stay: {reason}"),
        });
    }

    /// A surface of the window, and a device that can show pictures on it if there is none. Where that fails the overlay
    /// says why.
    fn make_surface(&mut self) {
        self.surface = None;
        let Some(window) = self.android.native_window() else { return };
        match self.surface_of(window) {
            Ok(surface) => {
                self.surface = Some(surface);
                self.canvas = None;
            }
            Err(line) => {
                self.session.app.complain(line);
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

    fn frame(&mut self) {
        let scale = self.pixels_per_point();
        self.input.read(&self.android, scale);
        for _ in 0..self.input.take_backs() {
            if !self.session.app.back() {
                self.stage = Stage::Enough;
            }
        }
        let Some(window) = self.android.native_window() else { return };
        if let Some(share) = self.thermometer.as_mut().and_then(|meter| meter.share(Instant::now())) {
            self.session.app.set_thermal(share);
        }
        let size = screen::pixels(&window);
        if let Some(surface) = &mut self.surface {
            surface.follow(size, self.session.app.choices().vsync);
        }
        let input = egui::RawInput {
            events: self.input.take(),
            safe_area_insets: Some(self.safe_area(scale)),
            ..egui::RawInput::default()
        };
        // A script could fail here: there is none.
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
        self.tell();
    }

    fn show(&mut self, painting: &mut Painting, window: &NativeWindow) -> Shown {
        let Some(canvas) = &mut self.canvas else {
            // Only a picture of the window that is to be saved could fail: there is none.
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
            self.stage = Stage::Enough;
        }
    }

    /// Tells the system how frames go, and the log what went wrong.
    fn tell(&mut self) {
        let app = &self.session.app;
        let problem = app.problem();
        if problem != self.logged.as_deref() {
            problem.iter().for_each(|line| log::warn!("problem: {line}"));
            self.logged = problem.map(str::to_owned);
        }
        let kept_on = self.surface.is_some() && !app.rests();
        if kept_on != self.kept_on {
            self.kept_on = kept_on;
            let (on, none) = (WindowManagerFlags::KEEP_SCREEN_ON, WindowManagerFlags::empty());
            let (add, remove) = if kept_on { (on, none) } else { (none, on) };
            self.android.set_window_flags(add, remove);
        }
        let Some(rate) = app.choices().governor else { return };
        let goal = Duration::from_secs_f64(rate.budget_ms() * 1e-3);
        let frames = app.last_frame();
        if frames.0 > 0 {
            let hints = self.hints.get_or_insert_with(|| Hints::new(&pace::frame_threads(), goal));
            hints.iter_mut().for_each(|hints| hints.tell(frames, goal));
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

    fn safe_area(&self, scale: f32) -> egui::SafeAreaInsets {
        let insets = *self.insets.lock().unwrap_or_else(PoisonError::into_inner);
        let [left, top, right, bottom] = insets.map(|inset| inset as f32 / scale);
        egui::SafeAreaInsets(MarginF32 { left, right, top, bottom })
    }
}

//! What the activity and the system tell each other about frames: heat, frame times, whether the screen stays on.

use std::time::{Duration, Instant};

use android_activity::{AndroidApp, WindowManagerFlags};
use glimpse_app::App;

use crate::pace::{self, Hints, Thermometer};

/// What the system was told last, and the services that it is told through.
pub struct Feedback {
    thermometer: Option<Thermometer>,
    /// `None` until there are threads that make frames; then as the system gave them, which is asked once.
    hints: Option<Option<Hints>>,
    /// The screen does not go dark.
    kept_on: bool,
    /// The problem that was logged last.
    logged: Option<String>,
}

impl Feedback {
    /// Nothing has been told yet.
    pub fn new() -> Self {
        Self { thermometer: Thermometer::new(), hints: None, kept_on: false, logged: None }
    }

    /// The share of a frame's time that the system's heat leaves, where it is time to ask.
    pub fn thermal_share(&mut self, now: Instant) -> Option<f32> {
        self.thermometer.as_mut()?.share(now)
    }

    /// Logs a new problem, keeps the screen on while frames change on a surface, and reports the last frame's time.
    pub fn tell(&mut self, android: &AndroidApp, app: &App, has_surface: bool) {
        let problem = app.problem();
        if problem != self.logged.as_deref() {
            problem.iter().for_each(|line| log::warn!("problem: {line}"));
            self.logged = problem.map(str::to_owned);
        }
        let kept_on = has_surface && !app.rests();
        if kept_on != self.kept_on {
            self.kept_on = kept_on;
            let (on, none) = (WindowManagerFlags::KEEP_SCREEN_ON, WindowManagerFlags::empty());
            let (add, remove) = if kept_on { (on, none) } else { (none, on) };
            android.set_window_flags(add, remove);
        }
        let Some(rate) = app.choices().governor else { return };
        let goal = Duration::from_secs_f64(rate.budget_ms() * 1e-3);
        let frames = app.last_frame();
        if frames.0 > 0 {
            let hints = self.hints.get_or_insert_with(|| Hints::new(&pace::frame_threads(), goal));
            hints.iter_mut().for_each(|hints| hints.tell(frames, goal));
        }
    }
}

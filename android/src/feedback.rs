//! Exchanges frame statistics with the system: thermal headroom, frame times, and whether the screen stays on.

use std::time::{Duration, Instant};

use android_activity::{AndroidApp, WindowManagerFlags};
use glimpse_app::App;

use crate::pace::{self, Hints, Thermometer};

/// The system's services, and what they were told last.
pub struct Feedback {
    thermometer: Option<Thermometer>,
    /// `None` until frames are rendered. Then the result of one request to the system, which may have no hints.
    hints: Option<Option<Hints>>,
    /// The window has the flag that keeps the screen on.
    kept_on: bool,
    /// The error message that was logged last.
    logged: Option<String>,
}

impl Feedback {
    /// Requests the thermal service; nothing has been reported yet.
    pub fn new() -> Self {
        Self { thermometer: Thermometer::new(), hints: None, kept_on: false, logged: None }
    }

    /// The share of the frame time that thermal headroom allows; `None` until the next query is due.
    pub fn thermal_share(&mut self, now: Instant) -> Option<f32> {
        self.thermometer.as_mut()?.share(now)
    }

    /// Logs a new error message, keeps the screen on while frames change on a surface, and reports the time of the last
    /// frame.
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

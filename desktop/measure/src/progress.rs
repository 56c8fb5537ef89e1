//! A progress bar, shown only on a terminal.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

use crate::output::{self, Verbosity};

/// A progress bar on stderr; invisible if stderr is not a terminal, and to the quiet. Dropping it clears the bar.
pub struct Progress(ProgressBar);

impl Progress {
    /// Starts a bar that counts `steps` steps and shows the elapsed time.
    pub fn new(verbosity: Verbosity, steps: u64) -> Self {
        Self::start(verbosity, steps, "{bar:24} {pos}/{len} {msg} ({elapsed})")
    }

    /// Starts a bar for long work counted in units of about equal time: it shows the percentage done and the
    /// estimated time left.
    pub fn of_work(verbosity: Verbosity, units: u64) -> Self {
        Self::start(verbosity, units, "{bar:24} {percent} % {msg} ({elapsed}, {eta} to go)")
    }

    fn start(verbosity: Verbosity, steps: u64, template: &str) -> Self {
        if verbosity == Verbosity::Quiet || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template(template);
        Self(ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// Sets the message that names the current step.
    pub fn doing(&self, what: &str) {
        self.0.set_message(output::one_line(what).into_owned());
        self.0.tick();
    }

    /// Advances the bar by one step.
    pub fn step(&self) {
        self.steps(1);
    }

    /// Advances the bar by `count` steps.
    pub fn steps(&self, count: u64) {
        self.0.inc(count);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

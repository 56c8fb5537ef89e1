//! The progress bar: on a terminal only.

use std::io::IsTerminal;

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of that many steps on stderr, or nothing in a pipe. It goes away when it is dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// Starts the bar.
    pub fn new(steps: u64) -> Self {
        Self::start(steps, "{bar:24} {pos}/{len} {msg} ({elapsed})")
    }

    /// A bar of long work that is counted in units of equal time: it says how much is left of both.
    pub fn of_work(units: u64) -> Self {
        Self::start(units, "{bar:24} {percent} % {msg} ({elapsed}, {eta} to go)")
    }

    fn start(steps: u64, template: &str) -> Self {
        if !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let style = ProgressStyle::with_template(template);
        Self(ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar())))
    }

    /// Says what is being done now.
    pub fn doing(&self, what: &str) {
        self.0.set_message(what.to_owned());
        self.0.tick();
    }

    /// One step is done.
    pub fn step(&self) {
        self.steps(1);
    }

    /// So many are done.
    pub fn steps(&self, count: u64) {
        self.0.inc(count);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

//! The result of an update, for the shell.

use std::{path::PathBuf, time::Duration};

use glimpse::DisplayImage;

use crate::Painting;

/// What a picture of the frame is for.
#[derive(Clone, Debug, PartialEq)]
pub enum Capture {
    /// It is saved under that name, or under one chosen by the shell.
    Save(Option<PathBuf>),
    /// It is compared with that file, within bounds as they are typed.
    Compare(PathBuf, String),
}

/// A request to the shell.
#[derive(Debug)]
pub enum Request {
    /// Show the system's file dialog and call [`App::open`](crate::App::open) with the chosen file, or
    /// [`App::browse`](crate::App::browse) where the system has none.
    OpenDialog,
    /// Use a picture of the frame.
    Captured(Capture, DisplayImage),
    /// Store the names of recently opened files, the newest first.
    Remember(Vec<String>),
    /// Store [`App::cached_kernels`](crate::App::cached_kernels) for later runs.
    KeepKernels,
    /// Switch between full screen and window.
    FullScreen,
    /// Create a new device, as the last one was lost, and pass it to [`App::attach`](crate::App::attach).
    NewDevice,
    /// End the program.
    Quit,
}

/// The result of an update.
pub struct Update {
    /// Output of the overlay, to be drawn.
    pub painting: Painting,
    /// Changes of the clipboard, the pointer shape and the text input.
    pub platform: egui::PlatformOutput,
    /// Requests to the shell.
    pub requests: Vec<Request>,
    /// Longest time until the next update; messages of the worker and input may require an earlier one.
    pub repaint_after: Duration,
}

//! What an update of the app returns to the shell.

use std::{path::PathBuf, time::Duration};

use glimpse::DisplayImage;

use crate::Painting;

/// A request to the shell.
#[derive(Debug)]
pub enum Request {
    /// To show a file dialog, and to call [`App::open`](crate::App::open) with the file that a person chooses.
    OpenDialog,
    /// To save a picture under that name, or under one that the shell chooses.
    Save(Option<PathBuf>, DisplayImage),
    /// To store the names of recently opened files, the newest first.
    Remember(Vec<String>),
    /// To switch between full screen and window.
    FullScreen,
    /// To create a new device, as the last one was lost, and to call [`App::attach`](crate::App::attach) with it.
    NewDevice,
    /// To end the program.
    Quit,
}

/// The result of an update.
pub struct Update {
    /// The overlay's output, to be drawn.
    pub painting: Painting,
    /// Changes of clipboard, pointer shape and text input.
    pub platform: egui::PlatformOutput,
    /// Further requests.
    pub requests: Vec<Request>,
    /// The longest time until the next update; messages of the worker and input may call for one earlier.
    pub repaint_after: Duration,
}

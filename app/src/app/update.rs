//! What an update of the app gives to the shell.

use std::{path::PathBuf, time::Duration};

use glimpse::DisplayImage;

use crate::Painting;

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

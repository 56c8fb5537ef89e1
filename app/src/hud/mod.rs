//! The overlay: what it shows, what it changes, what it wishes.

use crate::{Choices, Readings};

/// What a person wishes beyond a [`Choices`].
#[derive(Clone, Debug, PartialEq)]
pub enum Wish {
    /// To see that scene: `builtin:NAME` or a file.
    Open(String),
    /// To choose a file.
    OpenDialog,
    /// To save the frame.
    Screenshot,
    /// The `glimpse render` command of this frame in the clipboard.
    CopyCommand,
    /// The window as large as the screen, or not.
    FullScreen,
    /// The camera where the scene has it.
    ResetCamera,
    /// The scene's camera of that index.
    Camera(usize),
    /// The last problem has been read.
    CloseProblem,
    /// Enough.
    Quit,
}

/// What the overlay needs besides.
pub struct Hud<'a> {
    /// What it changes.
    pub choices: &'a mut Choices,
    /// What it shows.
    pub readings: &'a Readings,
    /// Scenes to choose from: the built-in ones, then those that were opened last.
    pub scenes: &'a [String],
}

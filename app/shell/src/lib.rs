//! What is around the app: a [`Session`] and a [`Surface`], which the desktop and Android have in common, and the desktop's
//! window on winit. No logic but the shell: how a frame is made and what a gesture means is the app's.

mod offscreen;
mod session;
mod surface;
mod touch;
#[cfg(not(target_os = "android"))]
mod window;

use std::path::{Path, PathBuf};

use glimpse::DisplayImage;
use glimpse_app::{Choices, Files, script::Script};

pub use offscreen::run as run_offscreen;
pub use session::{Leftover, RETRY, Session, Shown};
pub use surface::Surface;
#[cfg(not(target_os = "android"))]
pub use window::{Chosen, OpenDialog, Wakeup, run as run_window};

/// Saves a picture under a name, or under one of its own; returns what to tell.
pub type Save = Box<dyn FnMut(Option<PathBuf>, &DisplayImage) -> Result<String>>;

/// The first name in a folder that is free for a picture.
#[must_use]
pub fn free_name(folder: &Path) -> Option<PathBuf> {
    (1..).map(|i| folder.join(format!("glimpse-{i}.png"))).find(|path| !path.exists())
}

/// Keeps the names of files that were opened.
pub type Remember = Box<dyn FnMut(&[String])>;

/// What the platform lends.
pub struct Setup {
    /// Reads scenes.
    pub files: Files,
    /// The scene to begin with.
    pub scene: String,
    /// Files that were opened before.
    pub recent: Vec<String>,
    /// What is chosen at first.
    pub choices: Choices,
    /// Part of the name of the adapter to use.
    pub adapter: Option<String>,
    /// No limits of the device are higher.
    pub limits: Option<wgpu::Limits>,
    /// The screen that is emulated, in portrait; else the window's own.
    pub screen: Option<Screen>,
    /// Pixels of the frame of a view that rests, in landscape, whatever the screen has.
    pub view: Option<[u32; 2]>,
    /// Pixels of the window at first.
    pub size: [u32; 2],
    /// What happens by itself.
    pub script: Option<Script>,
    /// Saves a picture under a name, or under one of its own; returns what to tell.
    pub save: Save,
    /// Remembers files that were opened.
    pub remember: Remember,
}

/// A screen that is emulated.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    /// In portrait.
    pub pixels: [u32; 2],
    /// Pixels for a point of the overlay.
    pub pixels_per_point: f32,
    /// What the system and the shape of the screen take, in points: left, top, right, bottom, in portrait.
    pub insets: [f32; 4],
}

/// What went wrong, in one line.
pub type Result<T> = std::result::Result<T, String>;

//! The layer around the app: [`Session`] and [`Surface`], which the desktop and Android share, and the desktop's window
//! on winit. It has no logic beyond that: rendering and gestures are the app's.

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
pub use window::{DialogEnd, DialogEnded, OpenDialog, Wakeup, run as run_window};

/// Saves a picture under a name, or under one that it chooses; returns the confirmation to show.
pub type Save = Box<dyn FnMut(Option<PathBuf>, &DisplayImage) -> Result<String>>;

/// The first unused name `glimpse-N.png` in a folder.
#[must_use]
pub fn free_name(folder: &Path) -> Option<PathBuf> {
    (1..).map(|i| folder.join(format!("glimpse-{i}.png"))).find(|path| !path.exists())
}

/// Compares a picture with that file, within bounds as they are typed; an error says where it is beyond them.
pub type Compare = Box<dyn FnMut(&Path, &str, &DisplayImage) -> Result<()>>;

/// Prints a line to the standard output.
pub type Print = Box<dyn FnMut(&str) -> Result<()>>;

/// Stores fingerprints of the kernels in the driver's cache.
pub type KeepKernels = Box<dyn FnMut(&[u64])>;

/// Stores the names of recently opened files.
pub type Remember = Box<dyn FnMut(&[String])>;

/// What a platform provides to a session.
pub struct Setup {
    /// Reads scenes by their names.
    pub files: Files,
    /// Name of the first scene.
    pub scene: String,
    /// Names of files that were opened before.
    pub recent: Vec<String>,
    /// Fingerprints of the kernels that earlier runs left in the driver's cache.
    pub cached_kernels: Vec<u64>,
    /// The initial choices.
    pub choices: Choices,
    /// Part of the name of the graphics adapter to use.
    pub adapter: Option<String>,
    /// Upper bounds of the device's limits.
    pub limits: Option<wgpu::Limits>,
    /// The screen that is emulated, in portrait; `None` for the window itself.
    pub screen: Option<Screen>,
    /// Size of frames at full resolution in pixels, in landscape; `None` for the size of the screen.
    pub view: Option<[u32; 2]>,
    /// Initial size of the window in pixels.
    pub size: [u32; 2],
    /// A script to play.
    pub script: Option<Script>,
    /// Saves pictures.
    pub save: Save,
    /// Compares pictures that scripts expect.
    pub compare: Compare,
    /// Prints lines of scripts.
    pub print: Print,
    /// Stores recently opened files.
    pub remember: Remember,
    /// Stores what later runs get as [`Setup::cached_kernels`].
    pub keep_kernels: KeepKernels,
}

/// A screen that is emulated.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    /// Width and height in pixels, in portrait.
    pub pixels: [u32; 2],
    /// Pixels for a point of the overlay.
    pub pixels_per_point: f32,
    /// Insets at the left, top, right and bottom in points, in portrait, that cutouts or system bars cover.
    pub insets: [f32; 4],
}

/// The error is a message of one line.
pub type Result<T> = std::result::Result<T, String>;

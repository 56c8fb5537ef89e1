//! What the Java side answers from: content that URIs lead to, the display's cutout, the clipboard.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::{LazyLock, Mutex};

use super::reference;
use crate::sync::lock;

/// What a content URI leads to.
#[derive(Clone, Debug)]
pub enum Content {
    /// A file under the name that its provider gives it.
    File {
        /// Where it really is.
        path: PathBuf,
        /// `OpenableColumns.DISPLAY_NAME`.
        name: String,
    },
    /// The provider knows no such file.
    Missing,
    /// The app may not read it.
    Forbidden,
}

/// The surroundings of the activity.
#[derive(Default)]
pub struct World {
    /// By URI.
    pub content: HashMap<String, Content>,
    /// Safe insets of the display's cutout in pixels: left, top, right, bottom.
    pub cutout: Option<[i32; 4]>,
    /// The text of the clipboard.
    pub clipboard: Option<String>,
    /// What the app asked of the system's bars (`View.SYSTEM_UI_FLAG_*`).
    pub system_ui: i32,
}

static WORLD: LazyLock<Mutex<World>> = LazyLock::new(Mutex::default);

/// Reads or changes the surroundings.
pub fn with_world<T>(act: impl FnOnce(&mut World) -> T) -> T {
    act(&mut lock(&WORLD))
}

/// Number of references that are held: local, global and weak.
pub fn references() -> [usize; 3] {
    reference::count()
}

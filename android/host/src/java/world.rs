//! What the Java side answers from: content that URIs lead to, the display's cutout, the clipboard; and what was
//! called.

use std::collections::{BTreeMap, HashMap};
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
static CALLS: Mutex<BTreeMap<String, u64>> = Mutex::new(BTreeMap::new());

/// Reads or changes the surroundings.
pub fn with_world<T>(act: impl FnOnce(&mut World) -> T) -> T {
    act(&mut lock(&WORLD))
}

/// Notes a call of a method.
pub fn record(class: &str, method: &str) {
    let name = format!("{}.{method}", class.rsplit('/').next().unwrap_or(class));
    *lock(&CALLS).entry(name).or_default() += 1;
}

/// How often a method was called, as `Class.method`.
pub fn calls(name: &str) -> u64 {
    lock(&CALLS).get(name).copied().unwrap_or(0)
}

/// Number of references that are held: local, global and weak.
pub fn references() -> [usize; 3] {
    reference::count()
}

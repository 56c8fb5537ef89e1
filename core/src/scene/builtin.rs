//! Built-in scenes.
use super::Scene;

/// The names that [`builtin`] knows.
pub const BUILTIN_NAMES: [&str; 4] = ["room", "cornell", "minray", "furnace"];

/// A built-in scene by name.
#[must_use]
pub fn builtin(_name: &str) -> Option<Scene> {
    unimplemented!()
}

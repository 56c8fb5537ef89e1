//! Built-in scenes, made by code alone: the same triangles and texels everywhere. Sines and powers are therefore `libm`'s:
//! those of the platforms and of the compiler differ in the last bit.

mod cornell;
mod furnace;
mod furniture;
mod minray;
mod room;
mod shapes;
#[cfg(test)]
mod tests;
mod textures;
mod wires;

use super::Scene;

/// The names of the built-in scenes, as [`builtin`] takes them.
pub const BUILTIN_NAMES: [&str; 5] = ["room", "cornell", "minray", "furnace", "wires"];

/// A built-in scene by name; `None` where there is no such name. The first camera is called `main`.
#[must_use]
pub fn builtin(name: &str) -> Option<Scene> {
    match name {
        "room" => room::scene(),
        "cornell" => cornell::scene(),
        "minray" => Some(minray::scene()),
        "furnace" => furnace::scene(),
        "wires" => wires::scene(),
        _ => None,
    }
}

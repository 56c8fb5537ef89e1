//! What the phone and the desktop will share: camera and gestures, overlay, choice of scene, frame governor, life
//! cycle, in words of its own (neither winit's nor Android's).
//!
//! None of that is there yet. What is there is the list of scenes to choose from.

/// The scenes that can be chosen without a file, as `builtin:NAME`, in the order in which they are offered.
pub fn scenes() -> impl Iterator<Item = String> {
    glimpse::scene::BUILTIN_NAMES.iter().map(|name| format!("builtin:{name}"))
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_first_scene_is_the_room() {
        assert_eq!(super::scenes().next().as_deref(), Some("builtin:room"));
    }
}

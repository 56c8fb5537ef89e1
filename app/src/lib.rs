//! What the phone and the desktop share: camera and gestures, overlay, choice of scene, frame governor, life cycle, in
//! words of its own (neither winit's nor Android's).

mod camera_control;
mod choices;
mod gestures;
mod governor;
mod hud;
mod phones;
mod readings;

pub use camera_control::CameraControl;
pub use choices::{Choices, FrameRate, Navigation, Overlay, SCALES, Show, TEXT_SCALES, Vsync};
pub use gestures::{Gestures, Motion};
pub use governor::{FrameReport, Governor, Quality};
pub use hud::{Hud, Wish};
pub use phones::{Phone, Sourced};
pub use readings::{Busy, HISTORY, Readings};

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

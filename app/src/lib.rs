//! The application that the phone and the desktop share: camera control and gestures, overlay, scene list, frame-time
//! governor and life cycle. It uses no type of winit or Android.
//!
//! [`App`] is the entry point: a shell passes it input and time, and draws the [`Painting`] that it returns. A worker
//! thread ([`Worker`]) renders the frames, so input handling never waits for rendering.

mod app;
mod camera_control;
mod change;
mod choices;
mod command;
mod compiler;
mod conflicts;
mod folder;
mod gestures;
mod governor;
mod hud;
mod hud_state;
mod input_queue;
mod lenses;
mod loading;
mod mailbox;
mod painter;
mod phones;
mod scene_renderer;
pub mod script;
mod script_values;
mod view;
mod worker;
mod worker_events;

pub use app::{App, Capture, Request, Update};
pub use camera_control::CameraControl;
pub use change::Change;
pub use choices::{AtRest, Choices, FrameRate, Navigation, Overlay, SCALES, TEXT_SCALES, Vsync};
pub use folder::{Folder, FolderEntry};
pub use gestures::{Gestures, Motion};
pub use glimpse::Show;
pub use governor::{FrameReport, Governor, Quality};
pub use hud::{FLY_KEYS, Hud, UserRequest};
pub use hud_state::{Busy, HISTORY, HudState};
pub use lenses::Lenses;
pub use loading::{Opened, SceneFacts, StartCamera};
pub use painter::{Painter, Painting};
pub use phones::{Phone, Sourced};
pub use scene_renderer::{Counted, Job, RenderedFrame};
pub use worker::{Files, Wake, Worker, WorkerEvent};

/// Names of the built-in scenes, as `builtin:NAME`, in the order of the overlay's list.
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

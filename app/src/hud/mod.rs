//! The overlay: it displays the [`HudState`], edits the [`Choices`], and returns the user's requests.
//!
//! Everything is in separate egui areas above the picture; input outside of them goes to what the caller has
//! beneath.

mod actions;
mod amounts;
mod dialogs;
mod files;
mod graph;
mod help;
mod keys;
mod knobs;
mod measurements;
mod options;
mod panel;
mod places;
mod settings;
mod split;
mod status;
mod style;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use egui::{Context, Rect};

use crate::{Choices, HudState, Overlay};

pub use keys::FLY_KEYS;

/// A request of the user that is not a change of the [`Choices`].
#[derive(Clone, Debug, PartialEq)]
pub enum UserRequest {
    /// Open the scene of that name: `builtin:NAME` or a file.
    Open(String),
    /// Show the file dialog.
    OpenDialog,
    /// Show a folder in the list of files.
    Browse(PathBuf),
    /// Close the list of files.
    CloseFolder,
    /// Save the frame.
    Screenshot,
    /// Copy the `glimpse render` command of this frame to the clipboard.
    CopyCommand,
    /// Switch between full screen and window.
    FullScreen,
    /// Reset the camera to the scene's.
    ResetCamera,
    /// Move to the scene's camera of that index.
    Camera(usize),
    /// Close the error message.
    CloseProblem,
    /// End the program.
    Quit,
}

/// Input of the overlay for one pass.
pub struct Hud<'a> {
    /// Choices that the overlay edits.
    pub choices: &'a mut Choices,
    /// State that the overlay displays.
    pub hud_state: &'a HudState,
    /// Names of the scenes offered: the built-in ones, then the recent files.
    pub scenes: &'a [String],
    /// Rectangle of the picture, in points.
    pub picture: Rect,
    /// Whether input comes from fingers, so that every control must be large enough for them.
    pub touch: bool,
}

/// Least side of a window in points for which the overlay is drawn.
const LEAST_SIDE: f32 = style::TOUCH_TARGET;

/// The part of the window that shows the picture: all of it, or what is left of the panel where that has its place beside
/// the picture.
#[must_use]
pub fn picture_room(ctx: &Context, choices: &Choices) -> Rect {
    let is_beside = choices.overlay == Overlay::Full && is_large_enough(ctx);
    let beside = is_beside.then(|| panel::room_beside(ctx, choices.text_scale)).flatten();
    beside.unwrap_or_else(|| ctx.viewport_rect())
}

fn is_large_enough(ctx: &Context) -> bool {
    ctx.content_rect().size().min_elem() >= LEAST_SIDE
}

impl Hud<'_> {
    /// Handles the keys of this pass, shows the overlay, and returns the user's requests.
    ///
    /// Must be called once in each pass of `ctx`, after what lies beneath; it sets the style of `ctx`.
    #[must_use]
    pub fn show(mut self, ctx: &Context) -> Vec<UserRequest> {
        let pressed = keys::pressed(ctx, self.choices.navigation).into_iter();
        let mut user_requests: Vec<_> =
            pressed.filter_map(|(action, place)| actions::act(&mut self, action, place)).collect();
        style::apply(ctx, self.choices.text_scale, self.touch);
        if is_large_enough(ctx) {
            self.draw(ctx, &mut user_requests);
        }
        user_requests
    }

    fn draw(&mut self, ctx: &Context, user_requests: &mut Vec<UserRequest>) {
        split::show(ctx, self.choices, self.hud_state, self.picture);
        match self.choices.overlay {
            Overlay::Full => panel::show(ctx, self, user_requests),
            Overlay::Brief => status::show(ctx, self.choices, self.hud_state),
            // A touch screen without keys needs a way to show the overlay again.
            Overlay::Hidden if self.touch => status::faint_menu(ctx, self.choices),
            Overlay::Hidden => {}
        }
        if self.choices.overlay != Overlay::Hidden {
            dialogs::rendered(ctx, self.hud_state, self.picture);
        }
        dialogs::messages(ctx, self.hud_state, self.choices);
        help::show(ctx, self.choices);
        files::show(ctx, self.hud_state, self.choices.text_scale, user_requests);
        dialogs::problem(ctx, self.hud_state, self.choices.text_scale, user_requests);
    }
}

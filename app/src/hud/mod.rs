//! The overlay: what it shows, what it changes, what it wishes.
//!
//! Everything lies in areas of its own above the picture: where none is, input goes to what the caller has beneath.

mod actions;
mod amounts;
mod dialogs;
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

use egui::{Context, Rect};

use crate::{Choices, HudState, Overlay};

pub use keys::FLY_KEYS;

/// What a person wishes beyond a [`Choices`].
#[derive(Clone, Debug, PartialEq)]
pub enum UserRequest {
    /// To see that scene: `builtin:NAME` or a file.
    Open(String),
    /// To choose a file.
    OpenDialog,
    /// To save the frame.
    Screenshot,
    /// The `glimpse render` command of this frame in the clipboard.
    CopyCommand,
    /// The window as large as the screen, or not.
    FullScreen,
    /// The camera where the scene has it.
    ResetCamera,
    /// The scene's camera of that index.
    Camera(usize),
    /// The last problem has been read.
    CloseProblem,
    /// Enough.
    Quit,
}

/// What the overlay needs besides.
pub struct Hud<'a> {
    /// What it changes.
    pub choices: &'a mut Choices,
    /// What it shows.
    pub hud_state: &'a HudState,
    /// Scenes to choose from: the built-in ones, then those that were opened last.
    pub scenes: &'a [String],
    /// Where the picture is.
    pub picture: Rect,
    /// Fingers point, not a mouse: everything that can be hit is large enough for them.
    pub touch: bool,
}

/// The least side of a window in points in which there is something to read.
const LEAST_SIDE: f32 = style::TOUCH_TARGET;

impl Hud<'_> {
    /// Acts on the keys of this pass, shows everything, and returns what is wished.
    ///
    /// To be called once in each pass of `ctx`, after what lies beneath; the overlay sets the style of `ctx`.
    #[must_use]
    pub fn show(mut self, ctx: &Context) -> Vec<UserRequest> {
        let pressed = keys::pressed(ctx, self.choices.navigation).into_iter();
        let mut user_requests: Vec<_> =
            pressed.filter_map(|(action, place)| actions::act(&mut self, action, place)).collect();
        style::apply(ctx, self.choices.text_scale, self.touch);
        if ctx.content_rect().size().min_elem() >= LEAST_SIDE {
            self.draw(ctx, &mut user_requests);
        }
        user_requests
    }

    fn draw(&mut self, ctx: &Context, user_requests: &mut Vec<UserRequest>) {
        split::show(ctx, self.choices, self.hud_state, self.picture);
        match self.choices.overlay {
            Overlay::Full => panel::show(ctx, self, user_requests),
            Overlay::Brief => status::show(ctx, self.choices, self.hud_state),
            // Without keys there has to be a way back.
            Overlay::Hidden if self.touch => status::faint_menu(ctx, self.choices),
            Overlay::Hidden => {}
        }
        dialogs::messages(ctx, self.hud_state, self.choices.text_scale);
        help::show(ctx, self.choices);
        dialogs::problem(ctx, self.hud_state, self.choices.text_scale, user_requests);
    }
}

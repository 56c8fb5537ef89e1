//! Converts touch, mouse, trackpad and keys into camera motions.
//!
//! | input | motion |
//! | --- | --- |
//! | one finger, primary button | turn |
//! | secondary or middle button, shift and primary button | pan |
//! | two fingers | pan by their midpoint and dolly by their distance, simultaneously |
//! | wheel, two fingers on a trackpad | dolly; speed while flying |
//! | ctrl and wheel, pinch on a trackpad | dolly |
//! | double tap, double click | focus |
//! | arrow keys; with shift | turn; pan |
//! | page up, page down, `+`, `-` | dolly; speed while flying |
//! | the places of `W` `A` `S` `D` `Q` `E` on a US keyboard while flying; with shift | fly; fast |

#[cfg(test)]
mod tests;

use std::{collections::HashSet, time::Duration};

use egui::{Event, InputState, Key, PointerButton, Pos2, Rect, Response};
use glam::{Vec2, Vec3};

use crate::Navigation;

/// A camera motion derived from input.
///
/// Lengths are in view heights, x right and y up, so that they are independent of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Rotates about the orbit's centre, or about the eye while flying, so that the picture follows the hand.
    Turn {
        /// Distance of the drag in view heights.
        by: Vec2,
    },
    /// Translates parallel to the picture, so that the plane through the target follows the hand.
    Pan {
        /// Distance of the drag in view heights.
        by: Vec2,
    },
    /// Moves towards the target, which is magnified by e^by.
    Dolly {
        /// Exponent; negative moves away.
        by: f32,
        /// The position that stays fixed, in view heights from the centre of the view; `None` for the centre.
        at: Option<Vec2>,
    },
    /// Flies until the next frame.
    Fly {
        /// Velocity right, up and forward; 1 is full speed.
        along: Vec3,
    },
    /// Multiplies the flying speed by e^by.
    FlySpeed {
        /// Exponent; negative is slower.
        by: f32,
    },
    /// Moves the orbit's centre to the surface that is seen at a position.
    Focus {
        /// Position in view heights from the centre of the view.
        at: Vec2,
    },
}

/// Speed of an arrow key's rotation or pan, in view heights per second.
const KEY_DRAG: f32 = 0.5;

/// Exponent per second of a key for the dolly or the flying speed.
const KEY_DOLLY: f32 = 1.5;

/// Exponent per point of scrolling; a notch of a mouse wheel is 40 points.
const WHEEL: f32 = 1.0 / 200.0;

/// Flying speed without shift, as a share of full speed.
const STROLL: f32 = 0.25;

/// Recognises motions in the input of a view.
#[derive(Clone, Debug, Default)]
pub struct Gestures {
    /// Whether two fingers have been down since the first touched: a single remaining finger then does not
    /// rotate.
    pinched: bool,
    /// Keys that are held, by their places.
    held: HashSet<Key>,
}

impl Gestures {
    /// Motions of this frame. `response` belongs to the whole view and must sense clicks and drags; positions
    /// are measured in `picture`; `time` is the time since the last call. Keys are ignored while a widget has
    /// the focus or a dialog is open.
    pub fn read(
        &mut self,
        response: &Response,
        picture: Rect,
        navigation: Navigation,
        time: Duration,
    ) -> Vec<Motion> {
        let view = View { center: picture.center(), height: picture.height() };
        let over = response.contains_pointer() || response.dragged();
        let keys = response.ctx.memory(|memory| {
            memory.top_modal_layer().is_none() && memory.focused().is_none_or(|id| id == response.id)
        });
        let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let dragged = buttons.map(|button| response.dragged_by(button));
        let double_click = response.double_clicked().then(|| response.interact_pointer_pos()).flatten();
        let mut motions = Vec::new();
        response.ctx.input(|input| {
            let was_pinched = self.pinched;
            self.pinched = (input.multi_touch().is_some() || was_pinched) && input.any_touches();
            if over && view.height > 0.0 {
                match (self.pinched || was_pinched, double_click) {
                    (true, _) => motions.extend(pinch(input, &view)),
                    (false, Some(at)) => motions.push(Motion::Focus { at: view.at(at) }),
                    (false, None) => motions.extend(drag(input, &view, dragged)),
                }
                motions.extend(wheel(input, &view, navigation));
            }
            self.hold(&input.events);
            if keys {
                motions.extend(keyboard(input, &self.held, navigation, time.as_secs_f32()));
            }
        });
        motions
    }

    /// Follows which keys are held.
    fn hold(&mut self, events: &[Event]) {
        for event in events {
            match event {
                Event::Key { key, physical_key, pressed, .. } => {
                    let place = physical_key.unwrap_or(*key);
                    if *pressed {
                        self.held.insert(place)
                    } else {
                        self.held.remove(&place)
                    };
                }
                Event::WindowFocused(false) => self.held.clear(),
                _ => {}
            }
        }
    }
}

/// The rectangle of the picture, in points.
struct View {
    center: Pos2,
    height: f32,
}

impl View {
    /// Converts points to view heights, right and up.
    fn heights(&self, by: egui::Vec2) -> Vec2 {
        Vec2::new(by.x, -by.y) / self.height
    }

    fn at(&self, position: Pos2) -> Vec2 {
        self.heights(position - self.center)
    }
}

fn pinch(input: &InputState, view: &View) -> Vec<Motion> {
    let Some(touch) = input.multi_touch() else { return Vec::new() };
    let at = Some(view.at(touch.center_pos));
    some([
        Motion::Pan { by: view.heights(touch.translation_delta) },
        Motion::Dolly { by: touch.zoom_delta.ln(), at },
    ])
}

fn drag(input: &InputState, view: &View, [primary, secondary, middle]: [bool; 3]) -> Vec<Motion> {
    let by = view.heights(input.pointer.delta());
    if secondary || middle || (primary && input.modifiers.shift) {
        some([Motion::Pan { by }])
    } else if primary {
        some([Motion::Turn { by }])
    } else {
        Vec::new()
    }
}

fn wheel(input: &InputState, view: &View, navigation: Navigation) -> Vec<Motion> {
    if input.multi_touch().is_some() {
        return Vec::new();
    }
    let at = input.pointer.hover_pos().map(|position| view.at(position));
    let scrolled = input.smooth_scroll_delta().y * WHEEL;
    let scrolled = match navigation {
        Navigation::Orbit => Motion::Dolly { by: scrolled, at },
        Navigation::Fly => Motion::FlySpeed { by: scrolled },
    };
    some([scrolled, Motion::Dolly { by: input.zoom_delta().ln(), at }])
}

fn keyboard(input: &InputState, held: &HashSet<Key>, navigation: Navigation, seconds: f32) -> Vec<Motion> {
    if input.modifiers.ctrl || input.modifiers.command || input.modifiers.alt {
        return Vec::new();
    }
    let axis = |more: &[Key], less: &[Key]| {
        let down = |keys: &[Key]| f32::from(u8::from(keys.iter().any(|key| input.key_down(*key))));
        down(more) - down(less)
    };
    // An arrow key moves the camera, so the picture moves the opposite way.
    let arrows =
        -Vec2::new(axis(&[Key::ArrowRight], &[Key::ArrowLeft]), axis(&[Key::ArrowUp], &[Key::ArrowDown]));
    let by = arrows * KEY_DRAG * seconds;
    let nearer =
        axis(&[Key::PageUp, Key::Plus, Key::Equals], &[Key::PageDown, Key::Minus]) * KEY_DOLLY * seconds;
    let shift = input.modifiers.shift;
    let dragged = if shift { Motion::Pan { by } } else { Motion::Turn { by } };
    if navigation == Navigation::Orbit {
        return some([dragged, Motion::Dolly { by: nearer, at: None }]);
    }
    let along = |more, less| {
        let down = |key| f32::from(u8::from(held.contains(&key)));
        down(more) - down(less)
    };
    let along = Vec3::new(along(Key::D, Key::A), along(Key::E, Key::Q), along(Key::W, Key::S));
    let along = along.normalize_or_zero() * if shift { 1.0 } else { STROLL };
    some([dragged, Motion::FlySpeed { by: nearer }, Motion::Fly { along }])
}

/// Drops motions of length zero.
fn some<const N: usize>(motions: [Motion; N]) -> Vec<Motion> {
    let moves = |motion: &Motion| match *motion {
        Motion::Turn { by } | Motion::Pan { by } => by.is_finite() && by != Vec2::ZERO,
        Motion::Dolly { by, .. } | Motion::FlySpeed { by } => by.is_finite() && by != 0.0,
        Motion::Fly { along } => along != Vec3::ZERO,
        Motion::Focus { .. } => true,
    };
    motions.into_iter().filter(moves).collect()
}

//! The table of shortcuts, from which key presses are handled and the help page is made.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers};

use super::actions::Action;
use crate::Navigation;

/// Keys that move the camera in [`Navigation::Fly`], unless a modifier is held or the overlay has the keyboard focus: by
/// their places on a keyboard of the US, whatever letters they have.
pub const FLY_KEYS: [Key; 10] = [
    Key::W,
    Key::A,
    Key::S,
    Key::D,
    Key::Q,
    Key::E,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::ArrowLeft,
    Key::ArrowRight,
];

/// Keys that perform the same action.
pub struct Shortcut {
    /// The keys, any of which performs the action.
    pub keys: &'static [KeyboardShortcut],
    /// The action.
    pub action: Action,
    /// Description for the help page.
    pub does: &'static str,
}

/// All shortcuts, in the order of the help page.
pub const SHORTCUTS: [Shortcut; 22] = [
    shortcut(&[key(Key::H)], Action::Overlay, "overlay: hidden, one line, everything"),
    shortcut(&[key(Key::F1), key(Key::Questionmark)], Action::Help, "this page"),
    shortcut(
        &[key(Key::S), key(Key::F12), with_command(Key::S)],
        Action::Screenshot,
        "save the frame as a picture",
    ),
    shortcut(&[with_command(Key::C)], Action::CopyCommand, "copy the command that renders this frame"),
    shortcut(&[with_command(Key::O)], Action::Open, "open a scene"),
    shortcut(&SCENE_KEYS, Action::Scene, "the scene of that place in the list"),
    shortcut(&[key(Key::C)], Action::NextCamera, "next camera of the scene"),
    shortcut(&[key(Key::R)], Action::ResetCamera, "camera back to where it began"),
    shortcut(&[key(Key::N)], Action::Navigation, "orbit or fly"),
    shortcut(&[key(Key::M)], Action::Method, "next method"),
    shortcut(&[key(Key::B)], Action::Block, "next block size"),
    shortcut(&[key(Key::G)], Action::Governor, "governor: the next frame rate, or off"),
    shortcut(&[key(Key::V)], Action::Show, "show the next visualisation"),
    shortcut(&[key(Key::X)], Action::Split, "split screen against full tracing"),
    shortcut(&[key(Key::Plus), key(Key::Equals)], Action::ScaleUp, "finer resolution, without governor"),
    shortcut(&[key(Key::Minus)], Action::ScaleDown, "coarser resolution, without governor"),
    shortcut(&[with_command(Key::Plus), with_command(Key::Equals)], Action::LargerText, "larger text"),
    shortcut(&[with_command(Key::Minus)], Action::SmallerText, "smaller text"),
    shortcut(&[with_command(Key::Num0)], Action::UsualText, "text of the usual size"),
    shortcut(&[key(Key::F), key(Key::F11)], Action::FullScreen, "full screen"),
    shortcut(&[key(Key::Escape)], Action::Close, "close what is open"),
    shortcut(&[with_command(Key::Q)], Action::Quit, "quit"),
];

const SCENE_KEYS: [KeyboardShortcut; 9] = [
    key(Key::Num1),
    key(Key::Num2),
    key(Key::Num3),
    key(Key::Num4),
    key(Key::Num5),
    key(Key::Num6),
    key(Key::Num7),
    key(Key::Num8),
    key(Key::Num9),
];

const fn shortcut(keys: &'static [KeyboardShortcut], action: Action, does: &'static str) -> Shortcut {
    Shortcut { keys, action, does }
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn with_command(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::COMMAND, key)
}

/// Name of the first key of an action, for display; empty if there is none.
pub fn hint(ctx: &Context, action: Action) -> String {
    let shortcut = SHORTCUTS.iter().find(|shortcut| shortcut.action == action);
    shortcut
        .and_then(|shortcut| shortcut.keys.first())
        .map(|keys| ctx.format_shortcut(keys))
        .unwrap_or_default()
}

/// Name of the key that opens the scene at that index of the list, for display; empty if there is none.
pub fn scene_hint(ctx: &Context, place: usize) -> String {
    SCENE_KEYS.get(place).map(|keys| ctx.format_shortcut(keys)).unwrap_or_default()
}

/// Whether the key moves the camera in this mode and must not trigger a shortcut.
pub fn flies(keys: KeyboardShortcut, navigation: Navigation) -> bool {
    navigation == Navigation::Fly && keys.modifiers.is_none() && FLY_KEYS.contains(&keys.logical_key)
}

/// Actions of the keys pressed since the last pass, each with the index of the key in its row. Empty while a
/// text field has the focus.
pub fn pressed(ctx: &Context, navigation: Navigation) -> Vec<(Action, usize)> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    ctx.input(|input| input.events.iter().filter_map(|event| asked(event, navigation)).collect())
}

fn asked(event: &Event, navigation: Navigation) -> Option<(Action, usize)> {
    let (keys, place) = match event {
        // The shells' input layer reports the copy shortcut as this event.
        Event::Copy => (with_command(Key::C), Key::C),
        Event::Key { key, physical_key, pressed: true, repeat: false, modifiers } if !modifiers.alt => {
            // Shift is ignored, as some of the keys need it to be typed.
            let modifiers = if modifiers.command { Modifiers::COMMAND } else { Modifiers::NONE };
            (KeyboardShortcut::new(modifiers, *key), physical_key.unwrap_or(*key))
        }
        _ => return None,
    };
    if flies(keys, navigation) || flies(KeyboardShortcut { logical_key: place, ..keys }, navigation) {
        return None;
    }
    SHORTCUTS.iter().find_map(|shortcut| {
        let place = shortcut.keys.iter().position(|other| *other == keys)?;
        Some((shortcut.action, place))
    })
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn press(key: Key, modifiers: Modifiers) -> Event {
        Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
    }

    #[test]
    fn no_key_does_two_things() {
        let mut seen = HashSet::new();
        for keys in SHORTCUTS.iter().flat_map(|shortcut| shortcut.keys) {
            assert!(seen.insert(*keys), "{keys:?} twice");
        }
    }

    #[test]
    fn every_row_is_asked_for_by_each_of_its_keys() {
        for shortcut in &SHORTCUTS {
            for (place, keys) in shortcut.keys.iter().enumerate() {
                let event = press(keys.logical_key, keys.modifiers);
                assert_eq!(asked(&event, Navigation::Orbit), Some((shortcut.action, place)), "{keys:?}");
            }
        }
    }

    #[test]
    fn what_flies_asks_for_nothing_and_everything_can_be_asked_for_while_flying() {
        for key in FLY_KEYS {
            assert_eq!(asked(&press(key, Modifiers::NONE), Navigation::Fly), None, "{key:?}");
        }
        for shortcut in &SHORTCUTS {
            let left = shortcut.keys.iter().filter(|keys| !flies(**keys, Navigation::Fly)).count();
            assert!(left > 0, "no key is left to {}", shortcut.does);
        }
        let save = press(Key::S, Modifiers::COMMAND);
        assert_eq!(asked(&save, Navigation::Fly), Some((Action::Screenshot, 2)));
    }

    #[test]
    fn what_flies_is_known_by_its_place() {
        let at = |key, place| Event::Key {
            key,
            physical_key: Some(place),
            pressed: true,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(asked(&at(Key::X, Key::E), Navigation::Fly), None);
        assert_eq!(asked(&at(Key::X, Key::E), Navigation::Orbit), Some((Action::Split, 0)));
        assert_eq!(asked(&at(Key::X, Key::X), Navigation::Fly), Some((Action::Split, 0)));
    }

    #[test]
    fn copying_is_asked_for_by_the_event_that_stands_for_its_keys() {
        assert_eq!(asked(&Event::Copy, Navigation::Orbit), Some((Action::CopyCommand, 0)));
    }

    #[test]
    fn shift_that_a_key_needs_does_not_hide_it_and_alt_does() {
        let question = press(Key::Questionmark, Modifiers::SHIFT);
        assert_eq!(asked(&question, Navigation::Orbit), Some((Action::Help, 1)));
        assert_eq!(asked(&press(Key::H, Modifiers::ALT), Navigation::Orbit), None);
    }
}

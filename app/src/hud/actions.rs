//! Actions of the keys: each changes the choices or makes a request to the app.

use super::{Hud, UserRequest, options, settings};
use crate::{Choices, HudState, SCALES, TEXT_SCALES};

/// An action of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Action {
    Overlay,
    Help,
    Screenshot,
    CopyCommand,
    Open,
    Scene,
    NextCamera,
    ResetCamera,
    Navigation,
    Method,
    Block,
    Governor,
    Show,
    Split,
    ScaleUp,
    ScaleDown,
    LargerText,
    SmallerText,
    UsualText,
    FullScreen,
    Close,
    Quit,
}

/// Change of the resolution scale per key press.
const SCALE_STEP: f32 = 0.125;
/// Factor on the text size per key press.
const TEXT_STEP: f32 = 1.125;

/// Performs the action, or returns it as a request; `place` is the index of the pressed key among the keys of
/// the action.
pub fn act(hud: &mut Hud<'_>, action: Action, place: usize) -> Option<UserRequest> {
    let (hud_state, choices) = (hud.hud_state, &mut *hud.choices);
    // An error message, the list of files or the help page must be closed first.
    let waiting = hud_state.problem.is_some() || hud_state.folder.is_some() || choices.help;
    if waiting && !matches!(action, Action::Close | Action::Help | Action::Quit) {
        return None;
    }
    match action {
        Action::Screenshot => return Some(UserRequest::Screenshot),
        Action::CopyCommand => return Some(UserRequest::CopyCommand),
        Action::Open => return Some(UserRequest::OpenDialog),
        Action::Scene => return hud.scenes.get(place).cloned().map(UserRequest::Open),
        Action::NextCamera => return next_camera(hud_state),
        Action::ResetCamera => return Some(UserRequest::ResetCamera),
        Action::FullScreen => return Some(UserRequest::FullScreen),
        Action::Quit => return Some(UserRequest::Quit),
        Action::Close if hud_state.problem.is_some() => return Some(UserRequest::CloseProblem),
        Action::Close if hud_state.folder.is_some() => return Some(UserRequest::CloseFolder),
        Action::Close => choices.help = false,
        Action::Help => choices.help = !choices.help,
        Action::Overlay => choices.overlay = choices.overlay.next(),
        Action::Navigation => options::NAVIGATION.choose_next(choices),
        Action::Method | Action::Block => settings::choose_next(action, choices),
        Action::Governor if choices.governor_rests().is_some() => {}
        Action::Governor => options::GOVERNOR.choose_next(choices),
        Action::Show => options::SHOW.choose_next(choices),
        Action::Split => choices.toggle_split(),
        Action::ScaleUp => scale_by(choices, SCALE_STEP),
        Action::ScaleDown => scale_by(choices, -SCALE_STEP),
        Action::LargerText => text_by(choices, TEXT_STEP),
        Action::SmallerText => text_by(choices, 1.0 / TEXT_STEP),
        Action::UsualText => choices.text_scale = Choices::default().text_scale,
    }
    None
}

fn next_camera(hud_state: &HudState) -> Option<UserRequest> {
    let cameras = hud_state.cameras.len();
    (cameras > 0).then(|| UserRequest::Camera((hud_state.camera + 1) % cameras))
}

fn scale_by(choices: &mut Choices, step: f32) {
    if choices.scale_inapplicable().is_none() {
        choices.scale = (choices.scale + step).clamp(SCALES[0], SCALES[1]);
    }
}

fn text_by(choices: &mut Choices, factor: f32) {
    choices.text_scale = (choices.text_scale * factor).clamp(TEXT_SCALES[0], TEXT_SCALES[1]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hud::keys::SHORTCUTS;

    /// Choices and state on which every action has an effect.
    fn middling() -> (Choices, HudState) {
        let mut choices = Choices { governor: None, scale: 0.5, text_scale: 1.5, ..Choices::default() };
        choices.settings.block = 4;
        (choices, HudState { cameras: vec!["main".to_owned()], ..HudState::default() })
    }

    #[test]
    fn every_shortcut_does_something() {
        for shortcut in &SHORTCUTS {
            let (mut choices, hud_state) = middling();
            choices.help = shortcut.action == Action::Close;
            let before = choices;
            let scenes = ["builtin:room".to_owned()];
            let mut hud = Hud {
                choices: &mut choices,
                hud_state: &hud_state,
                scenes: &scenes,
                picture: egui::Rect::ZERO,
                touch: false,
            };
            let request = act(&mut hud, shortcut.action, 0);
            assert!(request.is_some() != (choices != before), "{:?}: {request:?}", shortcut.action);
        }
    }

    #[test]
    fn the_scale_stays_within_its_bounds_and_with_the_governor() {
        let (mut choices, _) = middling();
        (0..20).for_each(|_| scale_by(&mut choices, SCALE_STEP));
        assert_eq!(choices.scale, SCALES[1]);
        (0..20).for_each(|_| scale_by(&mut choices, -SCALE_STEP));
        assert_eq!(choices.scale, SCALES[0]);
        choices.governor = Choices::default().governor;
        scale_by(&mut choices, SCALE_STEP);
        assert_eq!(choices.scale, SCALES[0]);
    }
}

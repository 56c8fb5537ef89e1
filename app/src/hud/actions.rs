//! What keys do: each to the choices, or as a wish.

use super::{Hud, Wish, options};
use crate::{Choices, SCALES, TEXT_SCALES};

/// What a key does.
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

/// What a press of a key changes the scale by.
const SCALE_STEP: f32 = 0.125;

/// Does it; `place` is that of the key among those that do it.
pub fn act(hud: &mut Hud<'_>, action: Action, place: usize, wishes: &mut Vec<Wish>) {
    // A page that lies above everything waits for being closed.
    let waiting = hud.readings.problem.is_some() || hud.choices.help;
    if waiting && !matches!(action, Action::Close | Action::Help | Action::Quit) {
        return;
    }
    match action {
        Action::Close => close(hud, wishes),
        Action::Scene | Action::NextCamera => wishes.extend(place_wish(hud, action, place)),
        _ => match wish(action) {
            Some(wish) => wishes.push(wish),
            None => change(hud.choices, action),
        },
    }
}

fn close(hud: &mut Hud<'_>, wishes: &mut Vec<Wish>) {
    if hud.readings.problem.is_some() {
        wishes.push(Wish::CloseProblem);
    } else {
        hud.choices.help = false;
    }
}

fn place_wish(hud: &Hud<'_>, action: Action, place: usize) -> Option<Wish> {
    if action == Action::Scene {
        return hud.scenes.get(place).cloned().map(Wish::Open);
    }
    let cameras = hud.readings.cameras.len();
    (cameras > 0).then(|| Wish::Camera((hud.readings.camera + 1) % cameras))
}

fn wish(action: Action) -> Option<Wish> {
    match action {
        Action::Screenshot => Some(Wish::Screenshot),
        Action::CopyCommand => Some(Wish::CopyCommand),
        Action::Open => Some(Wish::OpenDialog),
        Action::ResetCamera => Some(Wish::ResetCamera),
        Action::FullScreen => Some(Wish::FullScreen),
        Action::Quit => Some(Wish::Quit),
        _ => None,
    }
}

fn change(choices: &mut Choices, action: Action) {
    match action {
        Action::Overlay => choices.overlay = choices.overlay.next(),
        Action::Help => choices.help = !choices.help,
        Action::Navigation => options::NAVIGATION.choose_next(choices),
        Action::Method => options::METHOD.choose_next(choices),
        Action::Block => options::BLOCK.choose_next(choices),
        Action::Governor => options::GOVERNOR.choose_next(choices),
        Action::Show => options::SHOW.choose_next(choices),
        Action::Split => choices.toggle_split(),
        Action::ScaleUp => scale_by(choices, SCALE_STEP),
        Action::ScaleDown => scale_by(choices, -SCALE_STEP),
        Action::LargerText => text_by(choices, 1.125),
        Action::SmallerText => text_by(choices, 1.0 / 1.125),
        Action::UsualText => choices.text_scale = Choices::default().text_scale,
        _ => {}
    }
}

fn scale_by(choices: &mut Choices, step: f32) {
    if choices.scale_rests().is_none() {
        choices.scale = (choices.scale + step).clamp(SCALES[0], SCALES[1]);
    }
}

fn text_by(choices: &mut Choices, factor: f32) {
    choices.text_scale = (choices.text_scale * factor).clamp(TEXT_SCALES[0], TEXT_SCALES[1]);
}

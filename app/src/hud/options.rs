//! The choices between a few values: one table for the buttons and for the keys.

use egui::{Button, Ui, vec2};
use glimpse::{Denoise, Method, Mip, Postcorrect, Preset, Stopping};

use super::actions::Action;
use super::{keys, style};
use crate::{Choices, FrameRate, Lenses, Navigation, Show, Vsync};

/// A choice between a few values.
pub struct Options<T: 'static> {
    /// What is chosen.
    pub name: &'static str,
    /// The values with their names, in the order in which they are offered.
    pub values: fn() -> Vec<(T, String)>,
    /// What chooses the next value, if a key does.
    action: Option<Action>,
    get: fn(&Choices) -> T,
    set: fn(&mut Choices, T),
}

impl<T: Copy + PartialEq> Options<T> {
    /// Chooses the next value that conflicts with nothing, in a circle.
    pub fn choose_next(&self, choices: &mut Choices) {
        let values = (self.values)();
        let now = values.iter().position(|(value, _)| *value == (self.get)(choices));
        let first = now.map_or(0, |now| now + 1);
        let following = (0..values.len()).map(|i| self.with(choices, values[(first + i) % values.len()].0));
        if let Some(next) = following.into_iter().find(|next| next.conflict().is_none()) {
            *choices = next;
        }
    }

    /// A row of buttons; those that conflict with other choices are disabled and say why, and all where `rests` does.
    pub fn buttons(&self, ui: &mut Ui, choices: &mut Choices, rests: Option<&str>) {
        let key = self.action.map(|action| keys::hint(ui.ctx(), action)).unwrap_or_default();
        style::caption(ui, format!("{}  {key}", self.name).trim_end());
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
            for (value, name) in (self.values)() {
                let next = self.with(choices, value);
                let button = Button::selectable((self.get)(choices) == value, name.as_str())
                    .frame_when_inactive(true)
                    .min_size(vec2(ui.spacing().interact_size.y, 0.0));
                let excluded = rests.or(next.conflict());
                let response = ui
                    .add_enabled(excluded.is_none(), button)
                    .accessible_name(format!("{}: {name}", self.name))
                    .on_disabled_hover_text(excluded.unwrap_or_default());
                if response.clicked() {
                    *choices = next;
                }
            }
        });
    }

    /// The name of the value that is chosen; empty where it is none of those that are offered.
    pub fn chosen(&self, choices: &Choices) -> String {
        let now = (self.get)(choices);
        (self.values)().into_iter().find(|(value, _)| *value == now).map(|(_, name)| name).unwrap_or_default()
    }

    fn with(&self, choices: &Choices, value: T) -> Choices {
        let mut next = *choices;
        (self.set)(&mut next, value);
        next
    }
}

fn named<T: Copy>(values: &[(T, &str)]) -> Vec<(T, String)> {
    values.iter().map(|(value, name)| (*value, (*name).to_owned())).collect()
}

pub const METHOD: Options<Method> = Options {
    name: "method",
    values: || {
        let order = [
            Method::Adaptive,
            Method::Full,
            Method::Supersample,
            Method::Quincunx,
            Method::Frameless,
            Method::Reproject,
            Method::Checkerboard,
            Method::Path,
            Method::Vr,
        ];
        named(&order.map(|method| (method, method.name())))
    },
    action: Some(Action::Method),
    get: |choices| choices.settings.method,
    set: |choices, method| {
        let before = std::mem::replace(&mut choices.settings.method, method);
        // Paths end by themselves.
        if method.follows_paths() != before.follows_paths() {
            choices.settings.depth = method.usual_depth();
        }
        // No other is added to.
        choices.settings.supersample &= method == Method::Adaptive;
    },
};

pub const SUPERSAMPLE: Options<bool> = Options {
    name: "extra samples",
    values: || named(&[(false, "off"), (true, "on")]),
    action: None,
    get: |choices| choices.settings.supersample,
    set: |choices, supersample| choices.settings.supersample = supersample,
};

pub const PRESET: Options<Option<Preset>> = Options {
    name: "thresholds",
    values: || named(&Preset::ALL.map(|preset| (Some(preset), preset.name()))),
    action: None,
    get: |choices| choices.settings.thresholds.preset(),
    set: |choices, preset| {
        if let Some(preset) = preset {
            choices.settings.thresholds = preset.thresholds();
        }
    },
};

pub const STOPPING: Options<Stopping> = Options {
    name: "away from the gaze",
    values: || {
        named(&[
            (Stopping::Off, "all paths"),
            (Stopping::Compensated, "fewer, compensated"),
            (Stopping::Paper, "fewer"),
        ])
    },
    action: None,
    get: |choices| choices.settings.paths.stopping,
    set: |choices, stopping| choices.settings.paths.stopping = stopping,
};

pub const DENOISE: Options<Denoise> = Options {
    name: "noise",
    values: || named(&Denoise::ALL.map(|denoise| (denoise, denoise.name()))),
    action: None,
    get: |choices| choices.settings.paths.denoise,
    set: |choices, denoise| choices.settings.paths.denoise = denoise,
};

pub const BLOCK: Options<u32> = Options {
    name: "block",
    values: || [2, 4, 8].map(|block| (block, format!("{block}x{block}"))).to_vec(),
    action: Some(Action::Block),
    get: |choices| choices.settings.block,
    set: |choices, block| choices.settings.block = block,
};

pub const SAMPLING: Options<u32> = Options {
    name: "samples a pixel",
    values: || [1, 2, 4].map(|side| (side, format!("{side}x{side}"))).to_vec(),
    action: None,
    get: |choices| choices.settings.sampling,
    set: |choices, side| choices.settings.sampling = side,
};

pub const POSTCORRECT: Options<Postcorrect> = Options {
    name: "postcorrection",
    values: || named(&Postcorrect::ALL.map(|wish| (wish, wish.name()))),
    action: None,
    get: |choices| choices.settings.postcorrect,
    set: |choices, postcorrect| choices.settings.postcorrect = postcorrect,
};

pub const MIP: Options<Mip> = Options {
    name: "averaged textures",
    values: || named(&Mip::ALL.map(|mip| (mip, mip.name()))),
    action: None,
    get: |choices| choices.settings.mip,
    set: |choices, mip| choices.settings.mip = mip,
};

pub const GOVERNOR: Options<Option<FrameRate>> = Options {
    name: "governor",
    values: || {
        named(&[
            (None, "off"),
            (Some(FrameRate::Fifteen), "15 fps"),
            (Some(FrameRate::Thirty), "30 fps"),
            (Some(FrameRate::Sixty), "60 fps"),
        ])
    },
    action: Some(Action::Governor),
    get: |choices| choices.governor,
    set: |choices, governor| choices.governor = governor,
};

pub const NAVIGATION: Options<Navigation> = Options {
    name: "navigation",
    values: || named(&[(Navigation::Orbit, "orbit"), (Navigation::Fly, "fly")]),
    action: Some(Action::Navigation),
    get: |choices| choices.navigation,
    set: |choices, navigation| choices.navigation = navigation,
};

pub const VSYNC: Options<Vsync> = Options {
    name: "vsync",
    values: || named(&[(Vsync::On, "on"), (Vsync::Newest, "newest"), (Vsync::Off, "off")]),
    action: None,
    get: |choices| choices.vsync,
    set: |choices, vsync| choices.vsync = vsync,
};

pub const LENSES: Options<Lenses> = Options {
    name: "lenses",
    values: || named(&Lenses::ALL.map(|lenses| (lenses, lenses.name()))),
    action: None,
    get: |choices| choices.lenses,
    set: |choices, lenses| choices.lenses = lenses,
};

pub const SHOW: Options<Show> = Options {
    name: "show",
    values: || Show::all().map(|show| (show, show.name())).collect(),
    action: Some(Action::Show),
    get: |choices| choices.show,
    set: |choices, show| choices.show = show,
};

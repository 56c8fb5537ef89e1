//! Choices between a few values: rows of buttons, and keys that select the next value.

use egui::{Button, Response, Ui, vec2};

use super::actions::Action;
use super::{keys, style};
use crate::{AtRest, Choices, FrameRate, Lenses, Navigation, Show, Vsync};

/// A choice between a few values.
pub struct Options<T: 'static> {
    /// Name of the choice.
    pub name: &'static str,
    /// The values with their names, in the order of the buttons.
    pub values: fn() -> Vec<(T, String)>,
    /// Action that selects the next value, if a key has it.
    action: Option<Action>,
    get: fn(&Choices) -> T,
    set: fn(&mut Choices, T),
}

/// A button that selects a value.
pub struct Offer {
    /// Text of the button.
    pub name: String,
    /// Explanation; may be empty.
    pub explained: &'static str,
    /// Whether the value is the current one.
    pub chosen: bool,
    /// Choices after the button is pressed.
    pub next: Choices,
}

/// Selects the next offer after the current one that conflicts with no other choice, in a circle.
pub fn choose_next(offers: &[Offer], choices: &mut Choices) {
    let first = offers.iter().position(|offer| offer.chosen).map_or(0, |chosen| chosen + 1);
    let mut following = (0..offers.len()).map(|i| &offers[(first + i) % offers.len()]);
    if let Some(offer) = following.find(|offer| offer.next.conflict().is_none()) {
        *choices = offer.next;
    }
}

/// A caption with the key of `action`, and a row of buttons. Buttons that conflict with other choices are
/// disabled and show the reason; all are disabled if `rests` gives a reason.
pub fn buttons(
    ui: &mut Ui,
    caption: &str,
    action: Option<Action>,
    offers: Vec<Offer>,
    choices: &mut Choices,
    rests: Option<&str>,
) -> Response {
    let key = action.map(|action| keys::hint(ui.ctx(), action)).unwrap_or_default();
    let response = style::caption(ui, format!("{caption}  {key}").trim_end());
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
        for Offer { name, explained, chosen, next } in offers {
            let button = Button::selectable(chosen, name.as_str())
                .frame_when_inactive(true)
                .min_size(vec2(ui.spacing().interact_size.y, 0.0));
            let excluded = rests.map(str::to_owned).or_else(|| next.conflict());
            let response = ui
                .add_enabled(excluded.is_none(), button)
                .accessible_name(format!("{caption}: {name}"))
                .on_disabled_hover_text(excluded.unwrap_or_default());
            let response = if explained.is_empty() { response } else { response.on_hover_text(explained) };
            if response.clicked() {
                *choices = next;
            }
        }
    });
    response
}

impl<T: Copy + PartialEq> Options<T> {
    fn offers(&self, choices: &Choices) -> Vec<Offer> {
        let offer = |(value, name)| {
            let mut next = *choices;
            (self.set)(&mut next, value);
            Offer { name, explained: "", chosen: (self.get)(choices) == value, next }
        };
        (self.values)().into_iter().map(offer).collect()
    }

    /// Selects the next value that conflicts with no other choice, in a circle.
    pub fn choose_next(&self, choices: &mut Choices) {
        choose_next(&self.offers(choices), choices);
    }

    /// Shows the row of buttons, see [`buttons`].
    pub fn buttons(&self, ui: &mut Ui, choices: &mut Choices, rests: Option<&str>) {
        buttons(ui, self.name, self.action, self.offers(choices), choices, rests);
    }
}

fn named<T: Copy>(values: &[(T, &str)]) -> Vec<(T, String)> {
    values.iter().map(|(value, name)| (*value, (*name).to_owned())).collect()
}

pub const GOVERNOR: Options<Option<FrameRate>> = Options {
    name: "governor",
    values: || {
        let fps = |(rate, name): (Option<FrameRate>, &str)| match rate {
            Some(_) => (rate, format!("{name} fps")),
            None => (rate, name.to_owned()),
        };
        FrameRate::GOVERNOR.map(fps).to_vec()
    },
    action: Some(Action::Governor),
    get: |choices| choices.governor,
    set: |choices, governor| choices.governor = governor,
};

pub const AT_REST: Options<AtRest> = Options {
    name: "at rest",
    values: || named(&AtRest::NAMED),
    action: None,
    get: |choices| choices.at_rest,
    set: |choices, at_rest| choices.at_rest = at_rest,
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

//! Controls for the options of a frame, generated from the core's table of options.

use egui::{TextEdit, Ui};
use glimpse::options::{Control, Kind, OptionSpec, Value};

use super::actions::Action;
use super::knobs::Knob;
use super::options::{self, Offer};
use super::style;
use crate::Choices;

/// Shows the control of an option: buttons, a slider or a text field. It is disabled if the option has no
/// effect.
pub fn show(ui: &mut Ui, option: &'static OptionSpec, choices: &mut Choices) {
    let rests = (!option.applies(&choices.settings)).then_some(option.applicability.reason);
    if let Some((knob, mut value)) = knob(option, choices) {
        let integer = matches!(option.kind, Kind::Integer { .. });
        if knob.show(ui, &mut value, rests) {
            let text = if integer { value.round().to_string() } else { (value as f32).to_string() };
            choose(option, &text, choices);
        }
        return;
    }
    let offers = offers(option, choices);
    if offers.is_empty() {
        field(ui, option, choices, rests);
    } else {
        let caption = options::buttons(ui, option.label, action(option), offers, choices, rests);
        caption.on_hover_text(option.summary);
    }
}

/// Shows the control of the method, which stands apart from the other options of its group.
pub fn show_method(ui: &mut Ui, choices: &mut Choices) {
    glimpse::options::OPTIONS
        .iter()
        .filter(|option| is_method(option))
        .for_each(|option| show(ui, option, choices));
}

/// Whether the option is the method.
pub fn is_method(option: &OptionSpec) -> bool {
    action(option) == Some(Action::Method)
}

/// Action that selects the option's next value, if a key has it.
fn action(option: &OptionSpec) -> Option<Action> {
    match option.name {
        "method" => Some(Action::Method),
        "block" => Some(Action::Block),
        _ => None,
    }
}

/// Selects the next value of the option whose key performs this action.
pub fn choose_next(key: Action, choices: &mut Choices) {
    let option = glimpse::options::OPTIONS.iter().find(|option| action(option) == Some(key));
    if let Some(option) = option.filter(|option| option.applies(&choices.settings)) {
        options::choose_next(&offers(option, choices), choices);
    }
}

/// Buttons of an option; empty if it has other controls.
fn offers(option: &OptionSpec, choices: &Choices) -> Vec<Offer> {
    let offer = |(name, text, explained): (String, String, &'static str)| {
        let mut next = *choices;
        option.set(&mut next.settings, &text).ok()?;
        let chosen = option.get(&choices.settings).to_string() == text;
        Some(Offer { name, explained, chosen, next })
    };
    let named: Vec<_> = match &option.kind {
        Kind::Choice { choices, .. } => {
            choices.iter().map(|c| (c.name.to_owned(), c.name.to_owned(), c.summary)).collect()
        }
        Kind::Flag(_) => ["off", "on"]
            .into_iter()
            .zip([false, true])
            .map(|(name, flag)| (name.to_owned(), Value::Flag(flag).to_string(), ""))
            .collect(),
        Kind::Integer { control: Control::Sides(sides), .. } => {
            sides.iter().map(|side| (format!("{side}x{side}"), side.to_string(), "")).collect()
        }
        _ => Vec::new(),
    };
    named.into_iter().filter_map(offer).collect()
}

/// Slider of an option and its value, if it has one. The mark is the paper's value, or the default.
fn knob(option: &'static OptionSpec, choices: &Choices) -> Option<(Knob, f64)> {
    let (Kind::Integer { control, .. } | Kind::Number { control, .. }) = &option.kind else { return None };
    let Control::Slider { low, high, step } = *control else { return None };
    let number = |settings: &glimpse::Settings| match option.get(settings) {
        Value::Integer(value) => Some(f64::from(value)),
        Value::Number(value) => Some(f64::from(value)),
        _ => None,
    };
    let usual = Choices::default().settings.with_method(choices.settings.method);
    let published = option.published.and_then(|published| published.value.parse().ok());
    let mark = match published {
        Some(value) => (value, "paper"),
        None => (number(&usual)?, "default"),
    };
    let step: f64 = step.to_string().parse().ok()?;
    let knob =
        Knob { name: option.label, explained: option.summary, range: [low, high].map(f64::from), step, mark };
    Some((knob, number(&choices.settings)?))
}

/// A text field for a value, which is applied when the field loses the focus.
fn field(ui: &mut Ui, option: &OptionSpec, choices: &mut Choices, rests: Option<&str>) {
    style::caption(ui, option.label).on_hover_text(option.summary);
    let id = ui.make_persistent_id(option.name);
    let now = option.get(&choices.settings).to_string();
    let mut text = ui.data_mut(|data| data.remove_temp(id)).unwrap_or(now);
    let edit = TextEdit::singleline(&mut text).id(id).desired_width(f32::INFINITY);
    let response = ui
        .add_enabled(rests.is_none(), edit)
        .accessible_name(option.label)
        .on_hover_text(option.kind.expected())
        .on_disabled_hover_text(rests.unwrap_or_default());
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
    } else if response.lost_focus() {
        choose(option, &text, choices);
    }
}

/// Sets the option unless no frame could be rendered with it.
fn choose(option: &OptionSpec, text: &str, choices: &mut Choices) {
    let mut next = *choices;
    if option.set(&mut next.settings, text).is_ok() && next.conflict().is_none() {
        *choices = next;
    }
}

#[cfg(test)]
mod tests {
    use glimpse::options::OPTIONS;

    use super::*;

    #[test]
    fn marks_are_papers_values_or_defaults_and_lie_on_their_sliders() {
        let usual = Choices::default();
        let mut seen = 0;
        for option in OPTIONS {
            let Some((knob, value)) = knob(option, &usual) else { continue };
            assert!((value - knob.mark.0).abs() < 1e-6, "{}", knob.name);
            assert!((knob.range[0] - 1e-6..=knob.range[1] + 1e-6).contains(&knob.mark.0), "{}", knob.name);
            seen += 1;
        }
        assert!(seen > 20, "{seen}");
    }

    #[test]
    fn the_ends_of_every_slider_are_settings() {
        for option in OPTIONS {
            let Some((knob, _)) = knob(option, &Choices::default()) else { continue };
            for end in knob.range {
                let mut settings = Choices::default().settings;
                option.set(&mut settings, &(end as f32).to_string()).unwrap();
                option.check(&settings).unwrap();
                assert!((end - option.get(&settings).to_string().parse::<f64>().unwrap()).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn every_option_has_a_control() {
        for option in OPTIONS {
            let field =
                matches!(option.kind, Kind::OptionalNumber { .. } | Kind::Point { .. } | Kind::Objects(_));
            let controls = [
                knob(option, &Choices::default()).is_some(),
                !offers(option, &Choices::default()).is_empty(),
                field,
            ];
            assert_eq!(controls.into_iter().filter(|control| *control).count(), 1, "{}", option.name);
        }
    }

    #[test]
    fn the_depth_follows_the_method_as_on_the_command_line() {
        let mut choices = Choices::default();
        while choices.settings.method != glimpse::Method::Path {
            choose_next(Action::Method, &mut choices);
        }
        assert_eq!(choices.settings.depth, glimpse::Settings::for_method(glimpse::Method::Path).depth);
    }
}

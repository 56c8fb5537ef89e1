//! Changes of the choices as text, for scripts and start intents.

use std::str::FromStr;

use glimpse::Show;
use glimpse::options::{self, OptionSpec};

use crate::{AtRest, Choices, FrameRate, Lenses, Overlay, SCALES};

/// A change of one of the [`Choices`].
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Sets an option of the frame's settings to a value given as text.
    Option(&'static OptionSpec, String),
    /// Sets the quantity that the picture shows.
    Show(Show),
    /// Splits the view at this share of the width, with full ray tracing to the right; `None` ends the split.
    Split(Option<f32>),
    /// Sets the lenses in front of the pictures for two eyes.
    Lenses(Lenses),
    /// Sets the resolution scale that applies while the governor is off.
    Scale(f32),
    /// Sets the frame rate that the governor holds; `None` turns it off.
    Governor(Option<FrameRate>),
    /// Sets the quality of the frame of a view at rest.
    AtRest(AtRest),
    /// Sets how much of the overlay is shown.
    Overlay(Overlay),
}

impl Change {
    /// Applies the change.
    ///
    /// # Errors
    /// Fails if the setting is invalid together with the others; the choices are then unchanged.
    pub fn apply(&self, choices: &mut Choices) -> Result<(), String> {
        match self {
            Self::Option(option, value) => {
                let mut settings = choices.settings;
                option.set(&mut settings, value).map_err(|error| error.to_string())?;
                settings.validate().map_err(|error| error.to_string())?;
                choices.settings = settings;
            }
            Self::Show(show) => choices.show = *show,
            Self::Split(split) => choices.split = *split,
            Self::Lenses(lenses) => choices.lenses = *lenses,
            Self::Scale(scale) => choices.scale = *scale,
            Self::Governor(governor) => choices.governor = *governor,
            Self::AtRest(at_rest) => choices.at_rest = *at_rest,
            Self::Overlay(overlay) => choices.overlay = *overlay,
        }
        Ok(())
    }
}

impl FromStr for Change {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, value) = text.split_once(' ').map_or((text, ""), |(name, value)| (name, value.trim()));
        Ok(match name {
            "show" => Self::Show(value.parse()?),
            "split" if value == "off" => Self::Split(None),
            "split" => Self::Split(Some(number_within(value, [0.0, 1.0])?)),
            "lenses" => Self::Lenses(one_of(value, &Lenses::ALL.map(|lenses| (lenses.name(), lenses)))?),
            "scale" => Self::Scale(number_within(value, SCALES)?),
            "governor" => {
                Self::Governor(one_of(value, &FrameRate::GOVERNOR.map(|(rate, name)| (name, rate)))?)
            }
            "at-rest" => Self::AtRest(one_of(value, &AtRest::NAMED.map(|(at_rest, name)| (name, at_rest)))?),
            "overlay" => Self::Overlay(one_of(
                value,
                &[("hidden", Overlay::Hidden), ("brief", Overlay::Brief), ("full", Overlay::Full)],
            )?),
            _ => option(name, value).map_err(|error| error.to_string())?,
        })
    }
}

/// A change of an option to a value that is valid for some frame; whether it fits the other choices is
/// checked when it is applied.
fn option(name: &str, value: &str) -> glimpse::Result<Change> {
    let option = options::find(name)?;
    let mut settings = Choices::default().settings;
    option.set(&mut settings, value)?;
    option.check(&settings)?;
    Ok(Change::Option(option, value.to_owned()))
}

fn number_within(text: &str, [low, high]: [f32; 2]) -> Result<f32, String> {
    let value: Option<f32> = text.parse().ok();
    value
        .filter(|value| (low..=high).contains(value))
        .ok_or_else(|| format!("expected a number from {low} to {high}, found `{text}`"))
}

fn one_of<T: Copy>(text: &str, values: &[(&str, T)]) -> Result<T, String> {
    values.iter().find(|(name, _)| *name == text).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<_> = values.iter().map(|(name, _)| *name).collect();
        format!("expected {}, found `{text}`", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use glimpse::options::OPTIONS;
    use glimpse::{Method, Settings};

    use super::*;

    #[test]
    fn choices_that_go_with_no_others_are_refused_at_once() {
        let methods: Vec<_> = Method::CHOICES.iter().map(|choice| choice.name).collect();
        let methods = format!("expected {}, found maybe", methods.join(", "));
        for (text, expected) in [
            ("block 3", "2, 4 or 8"),
            ("depth 0", "1 to 64"),
            ("t-norm x", "expected a number from -1 to 2, found x"),
            ("method maybe", methods.as_str()),
            ("refresh-fraction 0", "above 0 and at most 1"),
            ("split 1.5", "expected a number from 0 to 1, found `1.5`"),
            ("mip maybe", "expected off, on, found maybe"),
            ("color red", "expected one of method, sampling"),
            ("show everything", "expected one of final, origin"),
        ] {
            let error = text.parse::<Change>().unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }

    fn change(choices: &mut Choices, text: &str) -> Result<(), String> {
        text.parse::<Change>().expect(text).apply(choices)
    }

    #[test]
    fn a_change_that_does_not_go_with_the_others_changes_nothing() {
        let mut choices = Choices::default();
        change(&mut choices, "method checkerboard").expect("changed");
        let before = choices;
        assert!(change(&mut choices, "sampling 2").is_err());
        assert_eq!(choices, before);
    }

    #[test]
    fn every_option_can_be_set_by_its_present_and_by_its_old_name() {
        for option in OPTIONS {
            for value in option.kind.examples() {
                for name in [Some(option.name), option.old_name].into_iter().flatten() {
                    let changes: Vec<_> = Method::ALL
                        .into_iter()
                        .filter_map(|method| {
                            let mut choices = Choices::default();
                            change(&mut choices, &format!("method {}", method.name())).expect(name);
                            change(&mut choices, &format!("{name} {value}")).ok()?;
                            Some(option.get(&choices.settings).to_string())
                        })
                        .collect();
                    assert!(!changes.is_empty(), "{name} {value} goes with no method");
                    assert!(changes.iter().all(|text| *text == value), "{name} {value}: {changes:?}");
                }
            }
        }
    }

    #[test]
    fn a_method_brings_its_depth_as_on_the_command_line() {
        let mut choices = Choices::default();
        change(&mut choices, "method path").expect("changed");
        assert_eq!(choices.settings.depth, Settings::for_method(Method::Path).depth);
        assert_eq!(choices.settings.depth, 64);
        change(&mut choices, "method full").expect("changed");
        assert_eq!(choices.settings.depth, 3);
    }
}

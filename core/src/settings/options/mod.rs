//! The table of options: the name and description of every value of [`Settings`], the values that it accepts and
//! the frames that it affects.
//!
//! Command lines, scripts, controls, warnings, statistics and documentation are generated from [`OPTIONS`]. A new
//! option needs a field of [`Settings`] and a row of the table; a test fails if the row is missing.

mod applicability;
mod conflicts;
mod kind;
mod similar;
mod table;
#[cfg(test)]
mod tests;

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

pub use applicability::Applicability;
pub use kind::{Choice, Control, Integers, Kind, Numbers};
pub use similar::{similar, suggestion};
pub use table::OPTIONS;

use super::{Focus, Method, Settings};
use crate::{Error, Result};

/// One option of a frame: a row of the table.
#[derive(Debug)]
pub struct OptionSpec {
    /// The name, in lower case with hyphens: `t-pos`.
    pub name: &'static str,
    /// An earlier name, which is still accepted.
    pub old_name: Option<&'static str>,
    /// A short label for controls of user interfaces.
    pub label: &'static str,
    /// Description of the option in one sentence.
    pub summary: &'static str,
    /// Type of the value, its range and its field in the settings.
    pub kind: Kind,
    /// The value in the paper that the option comes from.
    pub published: Option<Published>,
    /// The group that lists the option in menus and documentation.
    pub group: Group,
    /// Whether short lists, such as `--help`, have the option too.
    pub essential: bool,
    /// The settings under which the option has an effect.
    pub applicability: &'static Applicability,
    conflict: fn(&Settings) -> Option<String>,
}

/// A value published in a paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Published {
    /// The value as text.
    pub value: &'static str,
    /// The paper, by the short name that the front page of this crate gives it.
    pub paper: &'static str,
}

/// Groups of options for menus and documentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Options of all methods.
    Frame,
    /// Adaptive undersampling (Kim 2016).
    Adaptive,
    /// Supersampling (Jin 2009; lecture).
    Supersampling,
    /// Path tracing.
    Paths,
    /// Stereo rendering (Kim & Sung 2021).
    Stereo,
}

impl Group {
    /// All groups, in the order of the menus.
    pub const ALL: [Self; 5] = [Self::Frame, Self::Adaptive, Self::Supersampling, Self::Paths, Self::Stereo];

    /// The group's heading.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Frame => "Frame",
            Self::Adaptive => "Adaptive method",
            Self::Supersampling => "Extra samples",
            Self::Paths => "Path tracing",
            Self::Stereo => "Two eyes",
        }
    }

    /// The group's options, in the order of the table.
    pub fn options(self) -> impl Iterator<Item = &'static OptionSpec> {
        OPTIONS.iter().filter(move |option| option.group == self)
    }
}

/// The value of an option.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// No value of its own, with the word for it; also that of a choice that no name describes, such as thresholds that
    /// are not a preset.
    #[serde(serialize_with = "null")]
    Absent(&'static str),
    /// `true` or `false`.
    Flag(bool),
    /// An integer.
    Integer(u32),
    /// A floating-point number.
    Number(f32),
    /// The name of one of the [`Choice`]s.
    Name(&'static str),
    /// A pair of numbers, written `X,Y`.
    Point([f32; 2]),
    /// First and last index of a range of objects, written `FIRST-LAST`.
    Indices([u32; 2]),
}

fn null<S: Serializer>(_: &&'static str, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_none()
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag(flag) => flag.fmt(f),
            Self::Integer(integer) => integer.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Name(name) | Self::Absent(name) => f.write_str(name),
            Self::Point([x, y]) => write!(f, "{x},{y}"),
            Self::Indices([first, last]) => write!(f, "{first}-{last}"),
        }
    }
}

/// Finds an option by its present or earlier name.
///
/// # Errors
/// [`Error::Setting`] lists the options if there is none of this name.
pub fn find(name: &str) -> Result<&'static OptionSpec> {
    let named = |option: &&OptionSpec| option.name == name || option.old_name == Some(name);
    OPTIONS.iter().find(named).ok_or_else(|| {
        let names: Vec<_> = OPTIONS.iter().map(|option| option.name).collect();
        let suggestion = suggestion(name, names.iter().copied());
        Error::setting("option", format!("one of {}{suggestion}", names.join(", ")), name)
    })
}

/// Options compare by name, which is unique.
impl PartialEq for OptionSpec {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl OptionSpec {
    const fn new(
        group: Group,
        name: &'static str,
        label: &'static str,
        kind: Kind,
        summary: &'static str,
    ) -> Self {
        let applicability = &applicability::ALWAYS;
        Self {
            name,
            old_name: None,
            label,
            summary,
            kind,
            published: None,
            group,
            essential: false,
            applicability,
            conflict: |_| None,
        }
    }

    const fn essential(self) -> Self {
        Self { essential: true, ..self }
    }

    const fn formerly(self, old_name: &'static str) -> Self {
        Self { old_name: Some(old_name), ..self }
    }

    const fn published(self, value: &'static str, paper: &'static str) -> Self {
        Self { published: Some(Published { value, paper }), ..self }
    }

    const fn with(self, applicability: &'static Applicability) -> Self {
        Self { applicability, ..self }
    }

    const fn conflicting(self, conflict: fn(&Settings) -> Option<String>) -> Self {
        Self { conflict, ..self }
    }

    /// The option's value in the settings.
    #[must_use]
    pub fn get(&self, settings: &Settings) -> Value {
        self.kind.get(&mut { *settings })
    }

    /// Parses a value and sets it. Only the form of the text is checked; [`OptionSpec::check`] and
    /// [`Settings::validate`] check the value.
    ///
    /// # Errors
    /// [`Error::Setting`] if the text does not have the form of a value; `settings` is then unchanged.
    pub fn set(&self, settings: &mut Settings, text: &str) -> Result<()> {
        self.kind.set(settings, text).ok_or_else(|| {
            let expected = self.kind.expected();
            let Kind::Choice { choices, .. } = &self.kind else { return self.error(expected, text) };
            let suggestion = suggestion(text, choices.iter().map(|choice| choice.name));
            self.error(expected + &suggestion, text)
        })
    }

    /// The option's default value for a method.
    #[must_use]
    pub fn default(&self, method: Method) -> Value {
        self.get(&Settings::for_method(method))
    }

    /// Whether the option has an effect on frames with these settings.
    #[must_use]
    pub fn applies(&self, settings: &Settings) -> bool {
        (self.applicability.to)(settings)
    }

    /// Checks that the option's value is within its range.
    ///
    /// # Errors
    /// [`Error::Setting`] with the expected range.
    pub fn check(&self, settings: &Settings) -> Result<()> {
        self.check_within(&mut { *settings })
    }

    /// As [`OptionSpec::check`], without a copy of the settings, which are left as they are.
    fn check_within(&self, settings: &mut Settings) -> Result<()> {
        if self.kind.holds(settings) {
            return Ok(());
        }
        Err(self.error(self.kind.expected(), &self.get(settings).to_string()))
    }

    /// Checks that the option's value does not conflict with other options.
    ///
    /// # Errors
    /// [`Error::Setting`] with the values that would be accepted.
    pub fn check_with_others(&self, settings: &Settings) -> Result<()> {
        let found = || self.get(settings).to_string();
        (self.conflict)(settings).map_or(Ok(()), |expected| Err(self.error(expected, &found())))
    }

    fn error(&self, expected: impl Into<String>, found: &str) -> Error {
        Error::setting(self.name, expected, found)
    }
}

impl Settings {
    /// The default settings of a method, which differ in [`Method::usual_depth`].
    #[must_use]
    pub fn for_method(method: Method) -> Self {
        Self { method, depth: method.usual_depth(), ..Self::default() }
    }

    /// The settings with another method. A default depth becomes that method's default. Options that the method
    /// does not use, and whose values it would reject, return to their defaults.
    #[must_use]
    pub fn with_method(&self, method: Method) -> Self {
        let usual = self.depth == self.method.usual_depth();
        let depth = if usual { method.usual_depth() } else { self.depth };
        Self { method, depth, ..*self }.without_foreign()
    }

    /// The settings with defaults for options that the method does not use and whose values it would reject.
    #[must_use]
    pub fn without_foreign(&self) -> Self {
        let mut settings = *self;
        for option in OPTIONS {
            if !option.applies(&settings) && option.check_with_others(&settings).is_err() {
                option.kind.copy(&Self::for_method(settings.method), &mut settings);
            }
        }
        settings
    }

    /// Parses a value and sets the option of this name.
    ///
    /// # Errors
    /// The errors of [`find`] and [`OptionSpec::set`].
    pub fn set(&mut self, name: &str, text: &str) -> Result<()> {
        find(name)?.set(self, text)
    }

    /// Checks the range of every option, and the options against each other.
    ///
    /// # Errors
    /// [`Error::Setting`] names the option, what was expected and what was found.
    pub fn validate(&self) -> Result<()> {
        let mut copy = *self;
        OPTIONS.iter().try_for_each(|option| option.check_within(&mut copy))?;
        OPTIONS.iter().try_for_each(|option| option.check_with_others(self))
    }

    /// The options, in the order of the table, whose values differ from the method's defaults; setting them on
    /// the defaults gives these settings.
    #[must_use]
    pub fn differences(&self) -> Vec<(&'static OptionSpec, Value)> {
        let mut reached = Self::for_method(self.method);
        let mut differing = Vec::new();
        if self.method != Self::default().method {
            differing.extend(OPTIONS.first().map(|method| (method, method.get(self))));
        }
        for option in OPTIONS {
            let value = option.get(self);
            if !matches!(value, Value::Absent(_)) && value != option.get(&reached) {
                option.kind.copy(self, &mut reached);
                differing.push((option, value));
            }
        }
        differing
    }
}

/// Serializes as a map of all options, with underscores instead of hyphens in their names.
impl Serialize for Settings {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(OPTIONS.len()))?;
        for option in OPTIONS {
            map.serialize_entry(&option.name.replace('-', "_"), &option.get(self))?;
        }
        map.end()
    }
}

impl From<Focus> for Value {
    fn from(focus: Focus) -> Self {
        Self::Indices([focus.first, focus.last])
    }
}

//! The table of options: what every value of [`Settings`] is called, what it does, which values it takes, and when it has
//! an effect.
//!
//! Command lines, scripts, controls, warnings, statistics and documentation follow from [`OPTIONS`]. A new option is a field
//! of [`Settings`] and a row of the table; a field without a row fails a test.

mod applicability;
mod conflicts;
mod kind;
mod table;
#[cfg(test)]
mod tests;

use std::fmt;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

pub use applicability::Applicability;
pub use kind::{Choice, Control, Integers, Kind, Numbers};
pub use table::OPTIONS;

use super::{Focus, Method, Settings};
use crate::{Error, Result};

/// One option of a frame.
#[derive(Debug)]
pub struct OptionSpec {
    /// The name, in lower case with hyphens: `t-pos`.
    pub name: &'static str,
    /// A name that it had before, still accepted.
    pub old_name: Option<&'static str>,
    /// A short name for controls.
    pub label: &'static str,
    /// What it does, in one sentence.
    pub summary: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// The value of the paper that the option comes from.
    pub published: Option<Published>,
    /// Where it stands in menus and documentation.
    pub group: Group,
    /// When it changes the frame.
    pub applicability: &'static Applicability,
    conflict: fn(&Settings) -> Option<String>,
}

/// A value that a paper uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Published {
    /// The value as text.
    pub value: &'static str,
    /// The paper, as the front page of this crate calls it.
    pub paper: &'static str,
}

/// Options that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Of every method.
    Frame,
    /// Undersampling (Kim 2016).
    Adaptive,
    /// Extra samples (Jin 2009; lecture).
    Supersampling,
    /// Path tracing.
    Paths,
    /// Two eyes (Kim & Sung 2021).
    Stereo,
}

impl Group {
    /// All of them, in order.
    pub const ALL: [Self; 5] = [Self::Frame, Self::Adaptive, Self::Supersampling, Self::Paths, Self::Stereo];

    /// A heading.
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

    /// Its options, in order.
    pub fn options(self) -> impl Iterator<Item = &'static OptionSpec> {
        OPTIONS.iter().filter(move |option| option.group == self)
    }
}

/// The value of an option.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// There is none, or none that the option could be set to.
    None,
    /// `true` or `false`.
    Flag(bool),
    /// A whole number.
    Integer(u32),
    /// A number.
    Number(f32),
    /// The name of a [`Choice`].
    Name(&'static str),
    /// Two numbers, `X,Y`.
    Point([f32; 2]),
    /// The first and the last of a run of indices, `FIRST-LAST`.
    Indices([u32; 2]),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str(kind::NONE),
            Self::Flag(flag) => flag.fmt(f),
            Self::Integer(integer) => integer.fmt(f),
            Self::Number(number) => number.fmt(f),
            Self::Name(name) => f.write_str(name),
            Self::Point([x, y]) => write!(f, "{x},{y}"),
            Self::Indices([first, last]) => write!(f, "{first}-{last}"),
        }
    }
}

/// The option of that name, present or old.
///
/// # Errors
/// [`Error::Setting`] lists the options.
pub fn find(name: &str) -> Result<&'static OptionSpec> {
    let named = |option: &&OptionSpec| option.name == name || option.old_name == Some(name);
    OPTIONS.iter().find(named).ok_or_else(|| {
        let names: Vec<_> = OPTIONS.iter().map(|option| option.name).collect();
        Error::setting("option", format!("one of {}", names.join(", ")), name)
    })
}

/// There is one option of a name.
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
            applicability,
            conflict: |_| None,
        }
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

    /// Its value in these settings.
    #[must_use]
    pub fn get(&self, settings: &Settings) -> Value {
        self.kind.get(&mut { *settings })
    }

    /// Sets it from text of the right form. Whether a frame can have the value is what [`OptionSpec::check`] and
    /// [`Settings::validate`] say.
    ///
    /// # Errors
    /// [`Error::Setting`] where the text has not the form of a value; nothing is changed then.
    pub fn set(&self, settings: &mut Settings, text: &str) -> Result<()> {
        self.kind.set(settings, text).ok_or_else(|| self.error(self.kind.expected(), text))
    }

    /// Its default for a method.
    #[must_use]
    pub fn default(&self, method: Method) -> Value {
        self.get(&Settings::for_method(method))
    }

    /// Does it change the frame?
    #[must_use]
    pub fn applies(&self, settings: &Settings) -> bool {
        (self.applicability.to)(settings)
    }

    /// Checks that its value is within the range.
    ///
    /// # Errors
    /// [`Error::Setting`] with the range.
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

    /// Checks that its value goes with those of the other options.
    ///
    /// # Errors
    /// [`Error::Setting`] with what would.
    pub fn check_with_others(&self, settings: &Settings) -> Result<()> {
        let found = || self.get(settings).to_string();
        (self.conflict)(settings).map_or(Ok(()), |expected| Err(self.error(expected, &found())))
    }

    fn error(&self, expected: impl Into<String>, found: &str) -> Error {
        Error::setting(self.name, expected, found)
    }
}

impl Settings {
    /// The defaults of a method: they differ in [`Method::usual_depth`].
    #[must_use]
    pub fn for_method(method: Method) -> Self {
        Self { method, depth: method.usual_depth(), ..Self::default() }
    }

    /// The same with another method. A depth that was the default becomes the default of that method, and options that the
    /// method neither uses nor accepts as they are become their defaults.
    #[must_use]
    pub fn with_method(&self, method: Method) -> Self {
        let usual = self.depth == self.method.usual_depth();
        let depth = if usual { method.usual_depth() } else { self.depth };
        Self { method, depth, ..*self }.without_foreign()
    }

    /// The same without options that the method neither uses nor accepts as they are: with their defaults.
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

    /// Sets an option by name from text of the right form.
    ///
    /// # Errors
    /// As [`find`] and [`OptionSpec::set`].
    pub fn set(&mut self, name: &str, text: &str) -> Result<()> {
        find(name)?.set(self, text)
    }

    /// Checks every value by itself, and all together.
    ///
    /// # Errors
    /// [`Error::Setting`] names the option, what was expected and what was found.
    pub fn validate(&self) -> Result<()> {
        let mut copy = *self;
        OPTIONS.iter().try_for_each(|option| option.check_within(&mut copy))?;
        OPTIONS.iter().try_for_each(|option| option.check_with_others(self))
    }

    /// The options that have to be set, in this order, to make these settings from the method's defaults.
    #[must_use]
    pub fn differences(&self) -> Vec<(&'static OptionSpec, Value)> {
        let mut reached = Self::for_method(self.method);
        let mut differing = Vec::new();
        if self.method != Self::default().method {
            differing.extend(OPTIONS.first().map(|method| (method, method.get(self))));
        }
        for option in OPTIONS {
            let value = option.get(self);
            if value != Value::None && value != option.get(&reached) {
                option.kind.copy(self, &mut reached);
                differing.push((option, value));
            }
        }
        differing
    }
}

/// Every option with its value, hyphens in names being underscores.
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

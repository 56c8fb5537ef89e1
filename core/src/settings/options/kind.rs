//! Types of options: the field of the settings, the textual form and the range of a value.

use std::str::FromStr;

use super::Value;
use crate::{Focus, Settings};

/// The word for an absent value.
const NONE: &str = "none";

/// Type of an option's value.
#[derive(Debug)]
pub enum Kind {
    /// A boolean, written `true` or `false`; parsing also accepts `on` and `off`.
    Flag(fn(&mut Settings) -> &mut bool),
    /// An integer.
    Integer {
        /// The field of the settings that holds it.
        field: fn(&mut Settings) -> &mut u32,
        /// Its allowed values.
        allowed: Integers,
        /// Its control in user interfaces.
        control: Control,
    },
    /// A floating-point number.
    Number {
        /// The field of the settings that holds it.
        field: fn(&mut Settings) -> &mut f32,
        /// Its allowed values.
        allowed: Numbers,
        /// Its control in user interfaces.
        control: Control,
    },
    /// A floating-point number or a word for none.
    OptionalNumber {
        /// The field of the settings that holds it.
        field: fn(&mut Settings) -> &mut Option<f32>,
        /// Its allowed values.
        allowed: Numbers,
        /// The word.
        absent: &'static str,
    },
    /// One of several names.
    Choice {
        /// The possible choices, in order.
        choices: &'static [Choice],
        /// Index of the current choice; `None` if the settings match none of them.
        get: fn(&Settings) -> Option<usize>,
        /// Sets the choice with this index into `choices`.
        set: fn(&mut Settings, usize),
    },
    /// A pair of numbers, written `X,Y`.
    Point {
        /// The field of the settings that holds it.
        field: fn(&mut Settings) -> &mut [f32; 2],
        /// Largest absolute value of each number.
        most: f32,
    },
    /// A range of the scene's objects, written `FIRST-LAST` or as one index, or `none`.
    Objects(fn(&mut Settings) -> &mut Option<Focus>),
}

/// One of the values of a [`Kind::Choice`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The choice's name.
    pub name: &'static str,
    /// An earlier name, which is still accepted.
    pub old_name: Option<&'static str>,
    /// Description of the choice in one sentence.
    pub summary: &'static str,
}

/// Allowed values of a [`Kind::Integer`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integers {
    /// All integers from the first to the second, both included.
    Range(u32, u32),
    /// Exactly these integers.
    OneOf(&'static [u32]),
}

/// Allowed values of a [`Kind::Number`]: the range from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Lower bound.
    pub low: f32,
    /// Upper bound; [`f32::MAX`] allows all finite numbers.
    pub high: f32,
    /// Whether `low` itself is allowed.
    pub with_low: bool,
    /// Whether `high` itself is allowed.
    pub with_high: bool,
}

/// The control of a number in user interfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// A slider; its range may be smaller than the allowed one.
    Slider {
        /// Least value of the slider.
        low: f32,
        /// Greatest value of the slider.
        high: f32,
        /// Distance between neighbouring values.
        step: f32,
    },
    /// A choice between these sides of a square.
    Sides(&'static [u32]),
}

impl Integers {
    fn hold(self, value: u32) -> bool {
        match self {
            Self::Range(least, most) => (least..=most).contains(&value),
            Self::OneOf(values) => values.contains(&value),
        }
    }

    fn expected(self) -> String {
        match self {
            Self::Range(least, u32::MAX) => format!("a whole number of at least {least}"),
            Self::Range(least, most) => format!("a whole number, {least} to {most}"),
            Self::OneOf(values) => {
                let texts: Vec<_> = values.iter().map(u32::to_string).collect();
                match texts.as_slice() {
                    [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
                    _ => texts.concat(),
                }
            }
        }
    }
}

impl Numbers {
    fn hold(self, value: f32) -> bool {
        let low = value > self.low || self.with_low && value == self.low;
        let high = value < self.high || self.with_high && value == self.high;
        low && high
    }

    fn expected(self) -> String {
        let readable = |number: f32| {
            if number >= 1e9 { format!("{number:e}") } else { number.to_string() }
        };
        let (low, high) = (readable(self.low), readable(self.high));
        match (self.with_low, self.with_high) {
            (true, _) if self.high == f32::MAX => format!("a number of at least {low}"),
            (true, true) => format!("a number from {low} to {high}"),
            (true, false) => format!("a number of at least {low} and below {high}"),
            (false, true) => format!("a number above {low} and at most {high}"),
            (false, false) => format!("a number above {low} and below {high}"),
        }
    }
}

impl Kind {
    /// Describes the accepted values, for error messages.
    #[must_use]
    pub fn expected(&self) -> String {
        match self {
            Self::Flag(_) => "true or false".to_owned(),
            Self::Integer { allowed, .. } => allowed.expected(),
            Self::Number { allowed, .. } => allowed.expected(),
            Self::OptionalNumber { allowed, absent, .. } => format!("{} or {absent}", allowed.expected()),
            Self::Choice { choices, .. } => {
                choices.iter().map(|choice| choice.name).collect::<Vec<_>>().join(", ")
            }
            Self::Point { most, .. } => format!("two numbers X,Y, each from -{most} to {most}"),
            Self::Objects(_) => {
                format!("indices FIRST-LAST, the first not behind the last, one index or {NONE}")
            }
        }
    }

    /// The placeholder of a value in usage texts.
    #[must_use]
    pub fn placeholder(&self) -> &'static str {
        match self {
            Self::Flag(_) => "BOOL",
            Self::Integer { .. } => "N",
            Self::Number { .. } | Self::OptionalNumber { .. } => "X",
            Self::Choice { .. } => "NAME",
            Self::Point { .. } => "X,Y",
            Self::Objects(_) => "OBJECTS",
        }
    }

    /// Example values as text: all names, both ends of sliders, one of each form otherwise.
    #[must_use]
    pub fn examples(&self) -> Vec<String> {
        let controlled = |control: &Control| match control {
            Control::Slider { low, high, .. } => vec![low.to_string(), high.to_string()],
            Control::Sides(sides) => sides.iter().map(u32::to_string).collect(),
        };
        match self {
            Self::Flag(_) => vec!["true".to_owned(), "false".to_owned()],
            Self::Integer { control, .. } | Self::Number { control, .. } => controlled(control),
            Self::OptionalNumber { allowed, absent, .. } => {
                vec![1_f32.min(allowed.high).to_string(), (*absent).to_owned()]
            }
            Self::Choice { choices, .. } => choices.iter().map(|choice| choice.name.to_owned()).collect(),
            Self::Point { .. } => vec!["0.25,-0.5".to_owned()],
            Self::Objects(_) => vec!["2-5".to_owned(), NONE.to_owned()],
        }
    }

    /// Its value. Fields are reached through what may change them, and are left as they are.
    pub(super) fn get(&self, settings: &mut Settings) -> Value {
        match self {
            Self::Flag(field) => Value::Flag(*field(settings)),
            Self::Integer { field, .. } => Value::Integer(*field(settings)),
            Self::Number { field, .. } => Value::Number(*field(settings)),
            Self::OptionalNumber { field, absent, .. } => {
                field(settings).map_or(Value::Absent(absent), Value::Number)
            }
            Self::Choice { choices, get, .. } => {
                let chosen = get(settings).and_then(|index| choices.get(index));
                chosen.map_or(Value::Absent(NONE), |choice| Value::Name(choice.name))
            }
            Self::Point { field, .. } => Value::Point(*field(settings)),
            Self::Objects(field) => field(settings).map_or(Value::Absent(NONE), Value::from),
        }
    }

    /// Parses a value and sets it; `None` if the text does not have its form.
    pub(super) fn set(&self, settings: &mut Settings, text: &str) -> Option<()> {
        match self {
            Self::Flag(field) => *field(settings) = flag(text)?,
            Self::Integer { field, .. } => *field(settings) = text.parse().ok()?,
            Self::Number { field, .. } => *field(settings) = text.parse().ok()?,
            Self::OptionalNumber { field, absent, .. } => *field(settings) = optional(text, absent)?,
            Self::Choice { choices, set, .. } => {
                set(settings, choices.iter().position(|choice| choice.is(text))?);
            }
            Self::Point { field, .. } => {
                let (x, y) = text.split_once(',')?;
                *field(settings) = [x.trim().parse().ok()?, y.trim().parse().ok()?];
            }
            Self::Objects(field) => *field(settings) = optional(text, NONE)?,
        }
        Some(())
    }

    /// Copies the option's value from one settings to another; does nothing if `from` has none.
    pub(super) fn copy(&self, from: &Settings, to: &mut Settings) {
        let mut from = *from;
        match self {
            Self::Flag(field) => *field(to) = *field(&mut from),
            Self::Integer { field, .. } => *field(to) = *field(&mut from),
            Self::Number { field, .. } => *field(to) = *field(&mut from),
            Self::OptionalNumber { field, .. } => *field(to) = *field(&mut from),
            Self::Choice { get, set, .. } => {
                if let Some(index) = get(&from) {
                    set(to, index);
                }
            }
            Self::Point { field, .. } => *field(to) = *field(&mut from),
            Self::Objects(field) => *field(to) = *field(&mut from),
        }
    }

    /// Whether the option's value is within its range.
    pub(super) fn holds(&self, settings: &mut Settings) -> bool {
        match (self, self.get(settings)) {
            (Self::Integer { allowed, .. }, Value::Integer(value)) => allowed.hold(value),
            (Self::Number { allowed, .. } | Self::OptionalNumber { allowed, .. }, Value::Number(value)) => {
                allowed.hold(value)
            }
            (Self::Point { most, .. }, Value::Point(point)) => point.iter().all(|c| c.abs() <= *most),
            (Self::Objects(_), Value::Indices([first, last])) => first <= last,
            _ => true,
        }
    }
}

impl Choice {
    /// Whether `text` is the choice's present or earlier name.
    #[must_use]
    pub fn is(&self, text: &str) -> bool {
        self.name.eq_ignore_ascii_case(text)
            || self.old_name.is_some_and(|old| old.eq_ignore_ascii_case(text))
    }
}

fn flag(text: &str) -> Option<bool> {
    match text {
        "true" | "on" => Some(true),
        "false" | "off" => Some(false),
        _ => None,
    }
}

fn optional<T: FromStr>(text: &str, absent: &str) -> Option<Option<T>> {
    if text == absent { Some(None) } else { text.parse().ok().map(Some) }
}

/// Parses `FIRST-LAST`, or a single index as both.
impl FromStr for Focus {
    type Err = std::num::ParseIntError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        Ok(Self { first: first.parse()?, last: last.parse()? })
    }
}

//! What an option takes: where it is kept, how it is written, and which values it may have.

use std::str::FromStr;

use super::Value;
use crate::{Focus, Settings};

/// How the absence of a value is written.
pub(super) const NONE: &str = "none";

/// What an option takes.
#[derive(Debug)]
pub enum Kind {
    /// `true` or `false`; `on` and `off` are read too.
    Flag(fn(&mut Settings) -> &mut bool),
    /// A whole number.
    Integer {
        /// Where it is kept.
        field: fn(&mut Settings) -> &mut u32,
        /// Its values.
        allowed: Integers,
        /// How it is chosen in a window.
        control: Control,
    },
    /// A number.
    Number {
        /// Where it is kept.
        field: fn(&mut Settings) -> &mut f32,
        /// Its values.
        allowed: Numbers,
        /// How it is chosen in a window.
        control: Control,
    },
    /// A number or `none`.
    OptionalNumber {
        /// Where it is kept.
        field: fn(&mut Settings) -> &mut Option<f32>,
        /// Its values.
        allowed: Numbers,
    },
    /// One of a few names.
    Choice {
        /// They, in order.
        choices: &'static [Choice],
        /// The index of what is chosen, where it has a name.
        get: fn(&Settings) -> Option<usize>,
        /// Chooses by index, which is one of `choices`.
        set: fn(&mut Settings, usize),
    },
    /// Two numbers `X,Y`.
    Point {
        /// Where they are kept.
        field: fn(&mut Settings) -> &mut [f32; 2],
        /// The largest magnitude of each.
        most: f32,
    },
    /// A run of a scene's objects, `FIRST-LAST` or one index, or `none`.
    Objects(fn(&mut Settings) -> &mut Option<Focus>),
}

/// A value of a [`Kind::Choice`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// Its name.
    pub name: &'static str,
    /// A name that it had before, still accepted.
    pub old_name: Option<&'static str>,
    /// What it does, in one sentence.
    pub summary: &'static str,
}

/// The values of a [`Kind::Integer`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integers {
    /// From the least to the largest.
    Range(u32, u32),
    /// These, in order.
    OneOf(&'static [u32]),
}

/// The values of a [`Kind::Number`]: from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// The lower end.
    pub low: f32,
    /// The upper end; [`f32::MAX`] for all that are finite.
    pub high: f32,
    /// Whether the lower end is one of them.
    pub with_low: bool,
    /// Whether the upper end is one of them.
    pub with_high: bool,
}

/// How a number is chosen in a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control {
    /// Along a range, which may be a part of what is allowed.
    Slider {
        /// The lower end.
        low: f32,
        /// The upper end.
        high: f32,
        /// The distance of neighbouring values.
        step: f32,
    },
    /// One of a few sides of a square.
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
    /// What its values look like.
    #[must_use]
    pub fn expected(&self) -> String {
        match self {
            Self::Flag(_) => "true or false".to_owned(),
            Self::Integer { allowed, .. } => allowed.expected(),
            Self::Number { allowed, .. } => allowed.expected(),
            Self::OptionalNumber { allowed, .. } => format!("{} or {NONE}", allowed.expected()),
            Self::Choice { choices, .. } => {
                choices.iter().map(|choice| choice.name).collect::<Vec<_>>().join(", ")
            }
            Self::Point { most, .. } => format!("two numbers X,Y, each from -{most} to {most}"),
            Self::Objects(_) => {
                format!("indices FIRST-LAST, the first not behind the last, one index or {NONE}")
            }
        }
    }

    /// A word that stands for a value in usage texts.
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

    /// Values that it takes, as text: every name, both ends of controls, forms of everything else.
    #[must_use]
    pub fn examples(&self) -> Vec<String> {
        let controlled = |control: &Control| match control {
            Control::Slider { low, high, .. } => vec![low.to_string(), high.to_string()],
            Control::Sides(sides) => sides.iter().map(u32::to_string).collect(),
        };
        match self {
            Self::Flag(_) => vec!["true".to_owned(), "false".to_owned()],
            Self::Integer { control, .. } | Self::Number { control, .. } => controlled(control),
            Self::OptionalNumber { allowed, .. } => {
                vec![1_f32.min(allowed.high).to_string(), NONE.to_owned()]
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
            Self::OptionalNumber { field, .. } => field(settings).map_or(Value::None, Value::Number),
            Self::Choice { choices, get, .. } => {
                let chosen = get(settings).and_then(|index| choices.get(index));
                chosen.map_or(Value::None, |choice| Value::Name(choice.name))
            }
            Self::Point { field, .. } => Value::Point(*field(settings)),
            Self::Objects(field) => field(settings).map_or(Value::None, Value::from),
        }
    }

    /// Sets it from text; `None` where the text has not its form.
    pub(super) fn set(&self, settings: &mut Settings, text: &str) -> Option<()> {
        match self {
            Self::Flag(field) => *field(settings) = flag(text)?,
            Self::Integer { field, .. } => *field(settings) = text.parse().ok()?,
            Self::Number { field, .. } => *field(settings) = text.parse().ok()?,
            Self::OptionalNumber { field, .. } => *field(settings) = optional(text)?,
            Self::Choice { choices, set, .. } => {
                set(settings, choices.iter().position(|choice| choice.is(text))?);
            }
            Self::Point { field, .. } => {
                let (x, y) = text.split_once(',')?;
                *field(settings) = [x.trim().parse().ok()?, y.trim().parse().ok()?];
            }
            Self::Objects(field) => *field(settings) = optional(text)?,
        }
        Some(())
    }

    /// Gives `to` the value that `from` has, where it has one.
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

    /// Is the value within the range?
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
    /// Is that its name, present or old?
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

fn optional<T: FromStr>(text: &str) -> Option<Option<T>> {
    if text == NONE { Some(None) } else { text.parse().ok().map(Some) }
}

/// `FIRST-LAST`, or one index for both.
impl FromStr for Focus {
    type Err = std::num::ParseIntError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (first, last) = text.split_once('-').unwrap_or((text, text));
        Ok(Self { first: first.parse()?, last: last.parse()? })
    }
}

//! Expectations of a script about values of the app.

use std::{cmp::Ordering, fmt};

/// Compares the value of a name with a number or a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    pub(super) name: String,
    pub(super) operator: Operator,
    pub(super) value: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Equal,
    NotEqual,
    Less,
    AtMost,
    More,
    AtLeast,
    Contains,
}

impl Operator {
    pub(super) const ALL: [(&str, Self); 7] = [
        ("=", Self::Equal),
        ("!=", Self::NotEqual),
        ("<", Self::Less),
        ("<=", Self::AtMost),
        (">", Self::More),
        (">=", Self::AtLeast),
        ("contains", Self::Contains),
    ];

    fn text(self) -> &'static str {
        Self::ALL.iter().find(|(_, operator)| *operator == self).map_or("", |(text, _)| text)
    }
}

/// Value of a name.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, compared numerically.
    Number(f64),
    /// A text, compared as such.
    Text(String),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "`{text}`"),
        }
    }
}

impl From<glimpse::options::Value> for Value {
    fn from(value: glimpse::options::Value) -> Self {
        let text = value.to_string();
        match value {
            glimpse::options::Value::Integer(integer) => Self::Number(integer.into()),
            // Uses the decimal text: 0.3, not its nearest value in single precision.
            glimpse::options::Value::Number(number) => Self::Number(text.parse().unwrap_or(number.into())),
            _ => Self::Text(text),
        }
    }
}

impl Expectation {
    /// Name whose value is compared.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Compares a value. A missing value meets no expectation.
    ///
    /// # Errors
    /// Fails if the comparison does not hold; the message has the expected and the found value, without the
    /// line number.
    pub fn check(&self, found: Option<&Value>) -> Result<(), String> {
        let holds = match (found, self.operator) {
            (None, _) => false,
            (Some(Value::Text(text)), Operator::Contains) => text.contains(&self.value),
            (Some(Value::Text(text)), Operator::Equal) => *text == self.value,
            (Some(Value::Text(text)), Operator::NotEqual) => *text != self.value,
            (Some(Value::Number(number)), operator) => {
                let wanted: f64 = self.value.parse().map_err(|_| {
                    format!("expected a number to compare {} with, found `{}`", self.name, self.value)
                })?;
                number.partial_cmp(&wanted).is_some_and(|order| match operator {
                    Operator::Equal => order == Ordering::Equal,
                    Operator::NotEqual => order != Ordering::Equal,
                    Operator::Less => order == Ordering::Less,
                    Operator::AtMost => order != Ordering::Greater,
                    Operator::More => order == Ordering::Greater,
                    Operator::AtLeast => order != Ordering::Less,
                    Operator::Contains => false,
                })
            }
            (Some(Value::Text(_)), _) => false,
        };
        if holds {
            return Ok(());
        }
        let found = found.map_or_else(|| "no value yet".to_owned(), ToString::to_string);
        Err(format!("expected {} {} {}, found {found}", self.name, self.operator.text(), self.value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(operator: Operator, value: &str, found: Option<Value>) -> Result<(), String> {
        Expectation { name: "x".to_owned(), operator, value: value.to_owned() }.check(found.as_ref())
    }

    #[test]
    fn numbers_are_compared_as_numbers() {
        use Operator::{AtLeast, AtMost, Contains, Equal, Less, More, NotEqual};
        for (operator, below, equal, above) in [
            (Equal, false, true, false),
            (NotEqual, true, false, true),
            (Less, true, false, false),
            (AtMost, true, true, false),
            (More, false, false, true),
            (AtLeast, false, true, true),
            (Contains, false, false, false),
        ] {
            let holds = |number| check(operator, "10", Some(Value::Number(number))).is_ok();
            assert_eq!((holds(9.0), holds(10.0), holds(11.0)), (below, equal, above), "{operator:?}");
            assert!(!holds(f64::NAN), "{operator:?}");
        }
    }

    #[test]
    fn texts_are_compared_as_texts_and_nothing_is_never_expected() {
        let text = || Some(Value::Text("a room".to_owned()));
        assert!(check(Operator::Contains, "room", text()).is_ok());
        assert!(check(Operator::Equal, "room", text()).is_err());
        assert!(check(Operator::NotEqual, "room", text()).is_ok());
        let line = check(Operator::Less, "1", text()).unwrap_err();
        assert_eq!(line, "expected x < 1, found `a room`");
        for (_, operator) in Operator::ALL {
            assert_eq!(
                check(operator, "1", None).unwrap_err().split(", ").nth(1),
                Some("found no value yet")
            );
        }
    }
}

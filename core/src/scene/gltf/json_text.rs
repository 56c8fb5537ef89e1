//! Reads JSON texts (RFC 8259) into values.

use std::fmt::{self, Formatter};

use serde::de::{DeserializeSeed, Deserializer, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};

/// Values that are nested deeper are read as null. Nothing of glTF is half as deep.
const DEEPEST: usize = 64;

/// Reads a text. Integers may be written like `4.0` or `4e0`, as in JSON they are.
///
/// # Errors
/// Fails for what is no JSON, and for objects that have a name twice.
pub(super) fn read(text: &str) -> serde_json::Result<Value> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let value = Nested(0).deserialize(&mut deserializer)?;
    deserializer.end()?;
    Ok(value)
}

/// Reads a value at this depth.
struct Nested(usize);

impl<'de> DeserializeSeed<'de> for Nested {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        if self.0 < DEEPEST {
            return deserializer.deserialize_any(self);
        }
        deserializer.deserialize_ignored_any(IgnoredAny).map(|_| Value::Null)
    }
}

impl<'de> Visitor<'de> for Nested {
    type Value = Value;

    fn expecting(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        const EXACT: f64 = (1_u64 << 53) as f64;
        let negative_zero = value == 0.0 && value.is_sign_negative();
        let is_integer = value.fract() == 0.0 && value.abs() < EXACT && !negative_zero;
        Ok(if is_integer { (value as i64).into() } else { value.into() })
    }

    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(text.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Value, A::Error> {
        let mut elements = Vec::new();
        while let Some(element) = sequence.next_element_seed(Self(self.0 + 1))? {
            elements.push(element);
        }
        Ok(Value::Array(elements))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
        let mut members = Map::new();
        while let Some(name) = map.next_key::<String>()? {
            if members.contains_key(&name) {
                return Err(A::Error::custom(format_args!("duplicate field `{name}`")));
            }
            let value = map.next_value_seed(Self(self.0 + 1))?;
            members.insert(name, value);
        }
        Ok(Value::Object(members))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn integers_keep_their_value_in_any_form() {
        let found = read("[4.0, 4e0, 4, -1.0, 0.5, -0.0, 1e300, 18446744073709551615]").unwrap();
        assert_eq!(found, json!([4, 4, 4, -1, 0.5, -0.0, 1e300, u64::MAX]));
        assert_eq!(found[0].as_u64(), Some(4));
        assert!(found[5].as_f64().is_some_and(f64::is_sign_negative));
    }

    #[test]
    fn what_is_too_deep_is_passed_over_and_what_follows_is_not() {
        let deep = format!(r#"{{"a": {}1{}, "b": "c"}}"#, "[".repeat(100_000), "]".repeat(100_000));
        assert_eq!(read(&deep).unwrap()["b"], "c");
        assert!(read(&deep[..150_000]).is_err());
    }

    #[test]
    fn what_is_no_json_is_refused() {
        for text in ["", "[1,]", "{} x", r#"{"a":1,"a":2}"#, "nul"] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}

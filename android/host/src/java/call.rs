//! Calls of methods: from the bits of the C interface to values and back.

use std::ffi::c_void;

use super::class::{Call, Method};
use super::machine::{self, enter};
use super::object::{Exception, Object, State, Value};
use super::reference::{self, Kind};
use crate::report;

/// `jvalue`: the low bytes hold the argument.
pub type Argument = u64;

/// Whether a call is of an object's method or of a class's.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// `Call...MethodA`.
    Object,
    /// `CallStatic...MethodA`.
    Class,
    /// `NewObjectA`.
    New,
}

/// Calls a method; what it throws is pending afterwards.
pub unsafe fn call(of: Of, this: *mut c_void, method: *const Method, arguments: *const Argument) -> Value {
    enter("a method", false);
    let (Some(method), Some(this)) = (method.as_ref(), reference::resolve(this)) else {
        report::complain("a method of null, or no method, was called".to_owned());
        return fail("java/lang/NullPointerException", "null");
    };
    let class = match (&this.state, of) {
        (State::Class(class), Of::Class | Of::New) => class,
        _ => this.class,
    };
    if !class.has(method) || method.is_static != (of == Of::Class) {
        report::complain(format!("{}{} was called with a {}", method.name, method.signature, class.name));
        return fail("java/lang/NoSuchMethodError", method.name);
    }
    let arguments = values(method.signature, arguments);
    match (method.body)(&Call { this: &this, arguments: &arguments }) {
        Ok(value) => value,
        Err(exception) => {
            machine::throw(&exception);
            Value::NULL
        }
    }
}

fn fail(class: &'static str, message: &str) -> Value {
    machine::throw(&Exception { class, message: message.to_owned() });
    Value::NULL
}

/// The arguments by the types in a signature.
unsafe fn values(signature: &str, mut arguments: *const Argument) -> Vec<Value> {
    let mut values = Vec::new();
    let mut types = signature.trim_start_matches('(').chars();
    while let Some(first) = types.next().filter(|first| *first != ')') {
        let bits = *arguments;
        arguments = arguments.add(1);
        values.push(match first {
            'Z' => Value::Boolean(bits & 0xff != 0),
            'B' => Value::Int(i32::from(bits as i8)),
            'C' => Value::Int(i32::from(bits as u16)),
            'S' => Value::Int(i32::from(bits as i16)),
            'I' => Value::Int(bits as i32),
            'J' => Value::Long(bits as i64),
            _ => Value::Object(reference::resolve(bits as *mut c_void)),
        });
        let mut element = first;
        while element == '[' {
            element = types.next().unwrap_or(')');
        }
        if element == 'L' {
            types.by_ref().find(|c| *c == ';');
        }
    }
    values
}

/// A value as a new local reference.
pub fn to_reference(value: Value) -> *mut c_void {
    match value {
        Value::Object(object) => reference::make(Kind::Local, object),
        _ => std::ptr::null_mut(),
    }
}

/// A value that is a number.
pub fn to_number(value: &Value) -> i64 {
    match value {
        Value::Boolean(value) => i64::from(*value),
        Value::Int(value) => i64::from(*value),
        Value::Long(value) => *value,
        Value::Object(_) | Value::Void => 0,
    }
}

/// Makes an object with a constructor: a new throwable gets its message, other classes hold nothing.
pub unsafe fn construct(
    class: *mut c_void,
    method: *const Method,
    arguments: *const Argument,
) -> *mut c_void {
    let Some(State::Class(of)) = reference::resolve(class).map(|object| match object.state {
        State::Class(class) => State::Class(class),
        _ => State::Nothing,
    }) else {
        report::complain("NewObjectA without a class".to_owned());
        return std::ptr::null_mut();
    };
    match call(Of::New, class, method, arguments) {
        Value::Object(Some(text)) => {
            let message = text.text().unwrap_or_default();
            reference::make(Kind::Local, Some(Object::new(of, State::Text(message))))
        }
        Value::Void => reference::make(Kind::Local, Some(Object::new(of, State::Nothing))),
        _ => std::ptr::null_mut(),
    }
}

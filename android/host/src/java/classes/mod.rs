//! The classes that are played.

mod content;
mod lang;
mod view;

use super::class::{Class, class};
use super::object::{Exception, Value};

/// `java.lang.Object`.
pub static OBJECT: Class = class("java/lang/Object", &[], lang::OBJECT_METHODS);

/// All classes.
pub fn all() -> impl Iterator<Item = &'static Class> {
    [&OBJECT].into_iter().chain(lang::CLASSES).chain(content::CLASSES).chain(view::CLASSES)
}

/// What a method answers.
type Answer = Result<Value, Exception>;

/// A method that is known to exist and that nobody is expected to call.
fn uncalled(_call: &super::class::Call<'_>) -> Answer {
    Err(Exception {
        class: "java/lang/UnsupportedOperationException",
        message: "this method is not played".to_owned(),
    })
}

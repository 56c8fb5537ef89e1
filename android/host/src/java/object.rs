//! Java objects, values and exceptions.

use std::collections::HashMap;
use std::os::fd::OwnedFd;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};

use super::class::{Class, find};

/// A reference to an object, or null.
pub type Reference = Option<Arc<Object>>;

/// What an activity was started with (`android.content.Intent`).
#[derive(Clone, Debug, Default)]
pub struct Intent {
    /// `android.intent.action.*`.
    pub action: Option<String>,
    /// The URI of what is to be viewed.
    pub data: Option<String>,
    /// The URI of what is shared (`android.intent.extra.STREAM`).
    pub stream: Option<String>,
    /// Other extras that are strings.
    pub extras: HashMap<String, String>,
}

/// What an object holds, by its class.
pub enum State {
    /// Nothing that matters.
    Nothing,
    /// A string, a URI, a message of a throwable.
    Text(String),
    /// A text that can change: the name of a thread.
    Name(Mutex<String>),
    /// A class as an object.
    Class(&'static Class),
    /// An array of objects.
    Array(Mutex<Vec<Reference>>),
    /// An intent.
    Intent(Intent),
    /// An activity.
    Activity {
        /// What it was started with.
        intent: Arc<Object>,
        /// `finish` was called.
        finished: AtomicBool,
    },
    /// An open file, until its descriptor is taken.
    File(Mutex<Option<OwnedFd>>),
    /// The rows of a query that has one column, and the row it stands on.
    Cursor {
        /// Values of the column.
        rows: Vec<String>,
        /// Before the first row it is nothing.
        row: Mutex<Option<usize>>,
    },
    /// Pixels at the left, top, right and bottom.
    Insets([i32; 4]),
}

/// A Java object.
pub struct Object {
    /// Its class.
    pub class: &'static Class,
    /// What it holds.
    pub state: State,
}

impl Object {
    /// A new object.
    pub fn new(class: &'static Class, state: State) -> Arc<Self> {
        Arc::new(Self { class, state })
    }

    /// A new string.
    pub fn string(text: &str) -> Arc<Self> {
        Self::new(find("java/lang/String"), State::Text(text.to_owned()))
    }

    /// The text that it holds, if it holds one.
    pub fn text(&self) -> Option<String> {
        match &self.state {
            State::Text(text) => Some(text.clone()),
            State::Name(name) => Some(crate::sync::lock(name).clone()),
            _ => None,
        }
    }
}

/// A value of a call: an argument or what it answers.
#[derive(Clone)]
pub enum Value {
    /// Nothing.
    Void,
    /// `boolean`.
    Boolean(bool),
    /// `byte`, `char`, `short` or `int`.
    Int(i32),
    /// `long`.
    Long(i64),
    /// An object or null.
    Object(Reference),
}

impl Value {
    /// A string.
    pub fn string(text: &str) -> Self {
        Self::Object(Some(Object::string(text)))
    }

    /// Null.
    pub const NULL: Self = Self::Object(None);
}

/// An exception that a method throws: its class and its message.
pub struct Exception {
    /// With slashes.
    pub class: &'static str,
    /// What it says.
    pub message: String,
}

impl Exception {
    /// As an object.
    pub fn object(&self) -> Arc<Object> {
        Object::new(find(self.class), State::Text(self.message.clone()))
    }
}

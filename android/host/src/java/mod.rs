//! The Java side: a virtual machine with the classes of [`classes`], references that are counted, and exceptions that
//! stay pending until they are cleared. What it does not know fails the run.

mod call;
mod class;
mod classes;
mod machine;
mod object;
mod reference;
mod strings;
mod table;
mod world;

pub use machine::{callback, ended_attached, environment, vm};
pub use object::Intent;
pub use world::{Content, references, with_world};

use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use class::find;
use object::{Object, State};
use reference::Kind;

/// A new activity that was started with `intent`, as a global reference.
pub fn new_activity(intent: Intent) -> *mut c_void {
    let intent = Object::new(find("android/content/Intent"), State::Intent(intent));
    let activity = Object::new(
        find("android/app/NativeActivity"),
        State::Activity { intent, finished: AtomicBool::new(false) },
    );
    reference::make(Kind::Global, Some(Arc::clone(&activity)))
}

/// Whether `Activity.finish()` was called.
pub fn is_finished(activity: *mut c_void) -> bool {
    let activity = reference::resolve(activity);
    activity.is_some_and(|activity| match &activity.state {
        State::Activity { finished, .. } => finished.load(Ordering::SeqCst),
        _ => false,
    })
}

/// Takes the system's reference to an activity back.
pub fn end_activity(activity: *mut c_void) {
    reference::delete(Kind::Global, activity);
}

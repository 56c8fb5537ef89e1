//! `ANativeActivity`: the structure that is given to the app, and the functions that the app calls on it.

use std::collections::HashSet;
use std::ffi::{c_char, c_int, c_void};
use std::sync::Mutex;

use crate::input::AInputQueue;
use crate::report;
use crate::sync::lock;
use crate::window::ANativeWindow;

type Activity = *mut ANativeActivity;
/// A callback without arguments.
pub type Told = Option<unsafe extern "C" fn(Activity)>;
/// A callback with one argument.
pub type Given<T> = Option<unsafe extern "C" fn(Activity, T)>;

/// `ARect`, in pixels of the window.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct ARect {
    pub left: i32,
    pub top: i32,
    pub right: i32,
    pub bottom: i32,
}

/// Callbacks that the app sets in `ANativeActivity_onCreate`.
#[repr(C)]
#[derive(Default)]
pub struct ANativeActivityCallbacks {
    pub onStart: Told,
    pub onResume: Told,
    pub onSaveInstanceState: Option<unsafe extern "C" fn(Activity, *mut usize) -> *mut c_void>,
    pub onPause: Told,
    pub onStop: Told,
    pub onDestroy: Told,
    pub onWindowFocusChanged: Given<c_int>,
    pub onNativeWindowCreated: Given<*mut ANativeWindow>,
    pub onNativeWindowResized: Given<*mut ANativeWindow>,
    pub onNativeWindowRedrawNeeded: Given<*mut ANativeWindow>,
    pub onNativeWindowDestroyed: Given<*mut ANativeWindow>,
    pub onInputQueueCreated: Given<*mut AInputQueue>,
    pub onInputQueueDestroyed: Given<*mut AInputQueue>,
    pub onContentRectChanged: Given<*const ARect>,
    pub onConfigurationChanged: Told,
    pub onLowMemory: Told,
}

/// The structure of an activity, as in `native_activity.h`.
#[repr(C)]
pub struct ANativeActivity {
    pub callbacks: *mut ANativeActivityCallbacks,
    pub vm: *mut c_void,
    pub env: *mut c_void,
    /// The activity object, not its class, in spite of the name.
    pub clazz: *mut c_void,
    pub internalDataPath: *const c_char,
    pub externalDataPath: *const c_char,
    pub sdkVersion: i32,
    pub instance: *mut c_void,
    pub assetManager: *mut c_void,
    pub obbPath: *const c_char,
}

static ALIVE: Mutex<Option<HashSet<usize>>> = Mutex::new(None);
static FINISHED: Mutex<Vec<usize>> = Mutex::new(Vec::new());
static WINDOW_FLAGS: Mutex<u32> = Mutex::new(0);
static KEPT_ON: Mutex<Vec<usize>> = Mutex::new(Vec::new());

/// `AWINDOW_FLAG_KEEP_SCREEN_ON`.
pub const KEEP_SCREEN_ON: u32 = 0x80;

/// Registers an activity: the app may call functions on it from now on.
pub fn begin(activity: Activity) {
    lock(&ALIVE).get_or_insert_default().insert(activity as usize);
}

/// Unregisters an activity: a later call on it is an error of the app.
pub fn end(activity: Activity) {
    lock(&ALIVE).get_or_insert_default().remove(&(activity as usize));
    for of_activities in [&FINISHED, &KEPT_ON] {
        lock(of_activities).retain(|known| *known != activity as usize);
    }
}

/// The app has called `ANativeActivity_finish`.
pub fn is_finished(activity: Activity) -> bool {
    lock(&FINISHED).contains(&(activity as usize))
}

/// The window has the flag that keeps the screen on, as it does while frames change.
pub fn keeps_screen_on(activity: Activity) -> bool {
    lock(&KEPT_ON).contains(&(activity as usize))
}

/// All flags `AWINDOW_FLAG_*` that the app has set at any time.
pub fn window_flags() -> u32 {
    *lock(&WINDOW_FLAGS)
}

fn is_alive(activity: Activity, what: &str) -> bool {
    let alive = lock(&ALIVE).as_ref().is_some_and(|alive| alive.contains(&(activity as usize)));
    if !alive {
        report::complain(format!("{what} with an activity that is gone"));
    }
    alive
}

#[unsafe(no_mangle)]
extern "C" fn ANativeActivity_finish(activity: Activity) {
    if is_alive(activity, "ANativeActivity_finish") {
        lock(&FINISHED).push(activity as usize);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ANativeActivity_setWindowFlags(activity: Activity, add: u32, remove: u32) {
    if is_alive(activity, "ANativeActivity_setWindowFlags") {
        *lock(&WINDOW_FLAGS) |= add;
        let mut kept_on = lock(&KEPT_ON);
        kept_on.retain(|kept| (*kept, remove & KEEP_SCREEN_ON) != (activity as usize, KEEP_SCREEN_ON));
        if add & KEEP_SCREEN_ON != 0 {
            kept_on.push(activity as usize);
        }
    }
}

#[unsafe(no_mangle)]
extern "C" fn ANativeActivity_setWindowFormat(activity: Activity, _format: i32) {
    is_alive(activity, "ANativeActivity_setWindowFormat");
}

#[unsafe(no_mangle)]
extern "C" fn ANativeActivity_showSoftInput(activity: Activity, _flags: u32) {
    is_alive(activity, "ANativeActivity_showSoftInput");
}

#[unsafe(no_mangle)]
extern "C" fn ANativeActivity_hideSoftInput(activity: Activity, _flags: u32) {
    is_alive(activity, "ANativeActivity_hideSoftInput");
}

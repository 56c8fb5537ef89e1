//! The virtual machine: which threads are attached, what each of them has pending, and the invocation interface.
//!
//! The state of a thread is kept by its number and not in thread-local storage: the app detaches its threads in
//! destructors that run when such storage is already gone.

use std::collections::HashMap;
use std::ffi::{CStr, c_char, c_void};
use std::sync::{Arc, LazyLock, Mutex};

use super::class::find;
use super::object::{Exception, Object, State};
use super::{reference, table};
use crate::report;
use crate::sync::lock;

const OK: i32 = 0;
const DETACHED: i32 = -2;

struct Thread {
    object: Arc<Object>,
    /// Local references by frames.
    frames: Vec<Vec<usize>>,
    pending: Option<Arc<Object>>,
}

static THREADS: LazyLock<Mutex<HashMap<i32, Thread>>> = LazyLock::new(Mutex::default);

fn number() -> i32 {
    // SAFETY: a query.
    unsafe { libc::gettid() }
}

/// Whether this is the thread of the Java side's main loop.
pub fn is_main_thread() -> bool {
    number() == std::process::id() as i32
}

fn attach(name: &str) {
    let thread = || Thread {
        object: Object::new(find("java/lang/Thread"), State::Name(Mutex::new(name.to_owned()))),
        frames: vec![Vec::new()],
        pending: None,
    };
    lock(&THREADS).entry(number()).or_insert_with(thread);
}

/// Calls the app as Java calls a native method: with a frame of its own on an attached thread.
pub fn callback<T>(call: impl FnOnce() -> T) -> T {
    attach("main");
    reference::push_frame();
    let result = call();
    if let Some(exception) = take_pending() {
        report::complain(format!("a callback returned with an exception: {}", describe(&exception)));
    }
    reference::pop_frame();
    result
}

/// Threads that ended while they were attached, which ends an app on Android; each is named once.
pub fn ended_attached() -> Vec<String> {
    let gone = |number: &i32| !std::path::Path::new(&format!("/proc/self/task/{number}")).exists();
    let mut threads = lock(&THREADS);
    let numbers: Vec<i32> = threads.keys().copied().filter(gone).collect();
    numbers.iter().filter_map(|number| threads.remove(number)?.object.text()).collect()
}

/// The local references of this thread.
pub fn with_frames<T>(act: impl FnOnce(&mut Vec<Vec<usize>>) -> T) -> T {
    match lock(&THREADS).get_mut(&number()) {
        Some(thread) => act(&mut thread.frames),
        None => act(&mut Vec::new()),
    }
}

/// This thread as an object.
pub fn current_thread() -> Option<Arc<Object>> {
    lock(&THREADS).get(&number()).map(|thread| Arc::clone(&thread.object))
}

/// Throws: the exception is pending until it is cleared.
pub fn throw(exception: &Exception) {
    throw_object(exception.object());
}

/// Throws an object.
pub fn throw_object(exception: Arc<Object>) {
    if let Some(thread) = lock(&THREADS).get_mut(&number()) {
        thread.pending = Some(exception);
    }
}

/// The exception that is pending on this thread.
pub fn pending() -> Option<Arc<Object>> {
    lock(&THREADS).get(&number()).and_then(|thread| thread.pending.clone())
}

/// Clears the exception that is pending on this thread.
pub fn take_pending() -> Option<Arc<Object>> {
    lock(&THREADS).get_mut(&number()).and_then(|thread| thread.pending.take())
}

/// An exception in words.
pub fn describe(exception: &Object) -> String {
    format!("{}: {}", exception.class.name.replace('/', "."), exception.text().unwrap_or_default())
}

/// Notes a call of the function table; on Android these mistakes end the process.
pub fn enter(function: &str, stands_exceptions: bool) {
    let threads = lock(&THREADS);
    let Some(thread) = threads.get(&number()) else {
        drop(threads);
        return report::complain(format!("{function} on a thread that is not attached"));
    };
    if let Some(pending) = thread.pending.as_ref().filter(|_| !stands_exceptions) {
        let pending = describe(pending);
        drop(threads);
        report::complain(format!("{function} with an exception pending: {pending}"));
    }
}

/// The `JNIEnv` of every thread: what differs between threads is found by their number.
pub fn environment() -> *mut c_void {
    static TABLE: LazyLock<table::Environment> = LazyLock::new(table::functions);
    static POINTER: LazyLock<usize> = LazyLock::new(|| TABLE.as_ptr() as usize);
    (&raw const *POINTER).cast_mut().cast()
}

/// The `JavaVM`.
pub fn vm() -> *mut c_void {
    static TABLE: LazyLock<[usize; 8]> = LazyLock::new(|| {
        let attach = attach_current_thread as *const () as usize;
        [
            0,
            0,
            0,
            destroy as *const () as usize,
            attach,
            detach_current_thread as *const () as usize,
            get_environment as *const () as usize,
            attach,
        ]
    });
    static POINTER: LazyLock<usize> = LazyLock::new(|| TABLE.as_ptr() as usize);
    (&raw const *POINTER).cast_mut().cast()
}

extern "C" fn destroy(_vm: *mut c_void) -> i32 {
    report::complain("DestroyJavaVM, which Android does not have".to_owned());
    OK
}

/// `JavaVMAttachArgs`.
#[repr(C)]
struct Arguments {
    version: i32,
    name: *const c_char,
    group: *mut c_void,
}

unsafe extern "C" fn attach_current_thread(
    _vm: *mut c_void,
    out: *mut *mut c_void,
    arguments: *const Arguments,
) -> i32 {
    let name = arguments.as_ref().filter(|arguments| !arguments.name.is_null());
    attach(&name.map_or("Thread".into(), |arguments| CStr::from_ptr(arguments.name).to_string_lossy()));
    *out = environment();
    OK
}

extern "C" fn detach_current_thread(_vm: *mut c_void) -> i32 {
    let Some(thread) = lock(&THREADS).remove(&number()) else { return OK };
    if let Some(exception) = &thread.pending {
        report::complain(format!("a thread was detached with an exception: {}", describe(exception)));
    }
    reference::forget(&thread.frames.concat());
    OK
}

unsafe extern "C" fn get_environment(_vm: *mut c_void, out: *mut *mut c_void, _version: i32) -> i32 {
    let is_attached = lock(&THREADS).contains_key(&number());
    *out = if is_attached { environment() } else { std::ptr::null_mut() };
    if is_attached { OK } else { DETACHED }
}

//! `ALooper`: waits for file descriptors and wake-ups. Each thread has at most one.

use std::cell::RefCell;
use std::ffi::{c_int, c_void};
use std::os::fd::{AsRawFd as _, FromRawFd as _, OwnedFd};
use std::ptr;
use std::sync::{Arc, Mutex};

use crate::sync::lock;

type Callback = unsafe extern "C" fn(descriptor: c_int, events: c_int, data: *mut c_void) -> c_int;

const POLL_WAKE: c_int = -1;
const POLL_CALLBACK: c_int = -2;
const POLL_TIMEOUT: c_int = -3;
const POLL_ERROR: c_int = -4;
const EVENT_INPUT: c_int = 1;

#[derive(Clone, Copy)]
struct Source {
    descriptor: c_int,
    identifier: c_int,
    callback: Option<Callback>,
    data: *mut c_void,
}

/// Reference-counted by [`ALooper_acquire`], [`ALooper_release`] and the thread to which it belongs.
pub struct ALooper {
    sources: Mutex<Vec<Source>>,
    wake: OwnedFd,
}

// SAFETY: as on Android, the app must synchronise the data that its sources point to.
unsafe impl Send for ALooper {}
// SAFETY: the sources are behind a lock; for their data see above.
unsafe impl Sync for ALooper {}

thread_local! {
    static LOOPER: RefCell<Option<Arc<ALooper>>> = const { RefCell::new(None) };
}

/// Creates an eventfd with a counter of zero.
pub fn counter(flags: c_int) -> OwnedFd {
    // SAFETY: the descriptor is new and has no other owner.
    unsafe { OwnedFd::from_raw_fd(libc::eventfd(0, libc::EFD_NONBLOCK | libc::EFD_CLOEXEC | flags)) }
}

/// Adds one to a counter.
pub fn count_up(counter: &OwnedFd) {
    let one = 1u64;
    // SAFETY: reads eight bytes of a local variable.
    unsafe { libc::write(counter.as_raw_fd(), (&raw const one).cast(), 8) };
}

/// Takes one from a semaphore, or resets another counter to zero.
pub fn count_down(counter: &OwnedFd) {
    let mut taken = 0u64;
    // SAFETY: writes eight bytes to a local variable.
    unsafe { libc::read(counter.as_raw_fd(), (&raw mut taken).cast(), 8) };
}

/// Returns this thread's looper, which is created where there is none.
#[unsafe(no_mangle)]
pub extern "C" fn ALooper_prepare(_options: c_int) -> *mut ALooper {
    LOOPER.with_borrow_mut(|looper| {
        let looper =
            looper.get_or_insert_with(|| Arc::new(ALooper { sources: Mutex::default(), wake: counter(0) }));
        Arc::as_ptr(looper).cast_mut()
    })
}

#[unsafe(no_mangle)]
extern "C" fn ALooper_forThread() -> *mut ALooper {
    LOOPER.with_borrow(|looper| {
        looper.as_ref().map_or(ptr::null_mut(), |looper| Arc::as_ptr(looper).cast_mut())
    })
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ALooper_acquire(looper: *mut ALooper) {
    Arc::increment_strong_count(looper);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ALooper_release(looper: *mut ALooper) {
    Arc::decrement_strong_count(looper);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn ALooper_wake(looper: *mut ALooper) {
    count_up(&(*looper).wake);
}

/// Adds a descriptor, or replaces its callback.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ALooper_addFd(
    looper: *mut ALooper,
    descriptor: c_int,
    identifier: c_int,
    _events: c_int,
    callback: Option<Callback>,
    data: *mut c_void,
) -> c_int {
    let identifier = if callback.is_some() { POLL_CALLBACK } else { identifier };
    let mut sources = lock(&(*looper).sources);
    sources.retain(|source| source.descriptor != descriptor);
    sources.push(Source { descriptor, identifier, callback, data });
    drop(sources);
    // Wakes a wait on another thread, which must see the new descriptor. This thread is not waiting.
    if looper != ALooper_forThread() {
        ALooper_wake(looper);
    }
    1
}

/// Removes a descriptor; returns 1 if it was there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ALooper_removeFd(looper: *mut ALooper, descriptor: c_int) -> c_int {
    let mut sources = lock(&(*looper).sources);
    let before = sources.len();
    sources.retain(|source| source.descriptor != descriptor);
    c_int::from(sources.len() != before)
}

/// Waits for an event for at most `timeout` milliseconds, or without limit if that is negative.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ALooper_pollOnce(
    timeout: c_int,
    descriptor: *mut c_int,
    events: *mut c_int,
    data: *mut *mut c_void,
) -> c_int {
    let Some(looper) = LOOPER.with_borrow(Clone::clone) else { return POLL_ERROR };
    let sources = lock(&looper.sources).clone();
    let wait_for = |fd| libc::pollfd { fd, events: libc::POLLIN, revents: 0 };
    let mut waits = vec![wait_for(looper.wake.as_raw_fd())];
    waits.extend(sources.iter().map(|source| wait_for(source.descriptor)));
    match libc::poll(waits.as_mut_ptr(), waits.len() as libc::nfds_t, timeout) {
        0 => return POLL_TIMEOUT,
        // An interrupting signal counts as a wake-up.
        ready if ready < 0 => return POLL_WAKE,
        _ => {}
    }
    if waits[0].revents != 0 {
        count_down(&looper.wake);
    }
    let mut result = POLL_WAKE;
    for (source, wait) in sources.iter().zip(&waits[1..]).filter(|(_, wait)| wait.revents != 0) {
        let Some(callback) = source.callback else {
            set(descriptor, wait.fd);
            set(events, EVENT_INPUT);
            set(data, source.data);
            return source.identifier;
        };
        if callback(source.descriptor, EVENT_INPUT, source.data) == 0 {
            ALooper_removeFd(Arc::as_ptr(&looper).cast_mut(), source.descriptor);
        }
        result = POLL_CALLBACK;
    }
    result
}

unsafe fn set<T>(place: *mut T, value: T) {
    if !place.is_null() {
        *place = value;
    }
}

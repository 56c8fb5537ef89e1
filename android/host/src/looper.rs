//! `ALooper`: waits for file descriptors and wake-ups, one looper a thread.

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

/// Counted as Android counts it: by [`ALooper_acquire`] and [`ALooper_release`], and by the thread it belongs to.
pub struct ALooper {
    sources: Mutex<Vec<Source>>,
    wake: OwnedFd,
}

// SAFETY: what the app lets its sources point to is the app's to share, as on Android.
unsafe impl Send for ALooper {}
// SAFETY: as above; the sources are behind a lock.
unsafe impl Sync for ALooper {}

thread_local! {
    static LOOPER: RefCell<Option<Arc<ALooper>>> = const { RefCell::new(None) };
}

/// A descriptor that counts what is written to it.
pub fn counter(flags: c_int) -> OwnedFd {
    // SAFETY: a fresh descriptor.
    unsafe { OwnedFd::from_raw_fd(libc::eventfd(0, libc::EFD_NONBLOCK | libc::EFD_CLOEXEC | flags)) }
}

/// Adds one to a counter.
pub fn count_up(counter: &OwnedFd) {
    let one = 1u64;
    // SAFETY: writes eight bytes from a local.
    unsafe { libc::write(counter.as_raw_fd(), (&raw const one).cast(), 8) };
}

/// Takes one, or all, from a counter.
pub fn count_down(counter: &OwnedFd) {
    let mut taken = 0u64;
    // SAFETY: reads eight bytes into a local.
    unsafe { libc::read(counter.as_raw_fd(), (&raw mut taken).cast(), 8) };
}

/// Gives this thread its looper, if it has none.
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

/// Adds or replaces a descriptor.
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
    // A wait in progress on another thread must see the new descriptor; this thread's own wait is not in progress.
    if looper != ALooper_forThread() {
        ALooper_wake(looper);
    }
    1
}

/// Takes a descriptor away; answers whether it was there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ALooper_removeFd(looper: *mut ALooper, descriptor: c_int) -> c_int {
    let mut sources = lock(&(*looper).sources);
    let before = sources.len();
    sources.retain(|source| source.descriptor != descriptor);
    c_int::from(sources.len() != before)
}

/// Waits for one event for at most `timeout` milliseconds (for ever if it is negative).
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
        // A signal is no error to a looper.
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

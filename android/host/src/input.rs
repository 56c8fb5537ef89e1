//! `AInputQueue` and its events: touches with several pointers and history, and keys.

use std::collections::VecDeque;
use std::ffi::{c_int, c_void};
use std::os::fd::{AsRawFd as _, OwnedFd};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use crate::looper::{self, ALooper, ALooper_addFd, ALooper_removeFd};
use crate::report;
use crate::sync::lock;

/// Values of `AMOTION_EVENT_ACTION_*` and `AKEY_EVENT_ACTION_*`.
pub mod action {
    /// The first pointer touches, or a key is pressed.
    pub const DOWN: i32 = 0;
    /// The last pointer is lifted, or a key is released.
    pub const UP: i32 = 1;
    /// At least one of the touching pointers has moved.
    pub const MOVE: i32 = 2;
    /// The system takes over the gesture.
    pub const CANCEL: i32 = 3;
    /// Another pointer touches; bits 8 and up hold its index.
    pub const POINTER_DOWN: i32 = 5;
    /// One of several pointers is lifted; bits 8 and up hold its index.
    pub const POINTER_UP: i32 = 6;
}

/// `AKEYCODE_BACK`.
pub const KEY_BACK: i32 = 4;
/// `AKEYCODE_VOLUME_UP`, a key that the app must leave to the system.
pub const KEY_VOLUME_UP: i32 = 24;

const TYPE_KEY: i32 = 1;
const TYPE_MOTION: i32 = 2;
const SOURCE_KEYBOARD: i32 = 0x101;
const SOURCE_TOUCHSCREEN: i32 = 0x1002;
const TOOL_FINGER: i32 = 1;
const AXIS_X: i32 = 0;
const AXIS_Y: i32 = 1;
const AXIS_PRESSURE: i32 = 2;

/// A pointer of a touch event, with its position in pixels of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointer {
    /// Constant while the finger touches.
    pub id: i32,
    /// Position from the left.
    pub x: f32,
    /// Position from the top.
    pub y: f32,
}

/// Times in nanoseconds of `CLOCK_MONOTONIC`.
#[derive(Clone, Copy, Debug)]
struct Times {
    down: i64,
    event: i64,
}

#[derive(Debug)]
enum What {
    Motion {
        action: i32,
        pointers: Vec<Pointer>,
        /// Earlier positions that the system batched into the event, the oldest first.
        history: Vec<Vec<Pointer>>,
    },
    Key {
        action: i32,
        code: i32,
    },
}

/// A touch or key event as the NDK hands it to the activity, with its times.
#[derive(Debug)]
pub struct AInputEvent {
    what: What,
    times: Times,
}

/// The input queue of an activity.
pub struct AInputQueue {
    counter: OwnedFd,
    waiting: Mutex<VecDeque<Box<AInputEvent>>>,
    looper: Mutex<Option<Arc<ALooper>>>,
    down: Mutex<i64>,
    /// Number of events that were pushed and not finished.
    pub unfinished: AtomicU64,
}

impl AInputQueue {
    /// Creates an empty queue.
    pub fn new() -> Self {
        Self {
            counter: looper::counter(libc::EFD_SEMAPHORE),
            waiting: Mutex::default(),
            looper: Mutex::default(),
            down: Mutex::new(0),
            unfinished: AtomicU64::new(0),
        }
    }

    /// Appends a touch event; `history` has the earlier positions of a batch, the oldest first.
    pub fn touch(&self, action: i32, pointers: &[Pointer], history: &[Vec<Pointer>]) {
        self.push(action, What::Motion { action, pointers: pointers.to_vec(), history: history.to_vec() });
    }

    /// Appends a key event.
    pub fn key(&self, action: i32, code: i32) {
        self.push(action, What::Key { action, code });
    }

    fn push(&self, action: i32, what: What) {
        let now = nanoseconds();
        let mut down = lock(&self.down);
        if action == action::DOWN {
            *down = now;
        }
        let times = Times { down: *down, event: now };
        lock(&self.waiting).push_back(Box::new(AInputEvent { what, times }));
        self.unfinished.fetch_add(1, Ordering::SeqCst);
        looper::count_up(&self.counter);
    }
}

fn nanoseconds() -> i64 {
    let mut now = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: writes to a local variable.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &raw mut now) };
    now.tv_sec * 1_000_000_000 + now.tv_nsec
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputQueue_attachLooper(
    queue: *mut AInputQueue,
    looper: *mut ALooper,
    identifier: c_int,
    _callback: *const c_void,
    data: *mut c_void,
) {
    AInputQueue_detachLooper(queue);
    Arc::increment_strong_count(looper);
    *lock(&(*queue).looper) = Some(Arc::from_raw(looper));
    ALooper_addFd(looper, (*queue).counter.as_raw_fd(), identifier, 1, None, data);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputQueue_detachLooper(queue: *mut AInputQueue) {
    if let Some(looper) = lock(&(*queue).looper).take() {
        ALooper_removeFd(Arc::as_ptr(&looper).cast_mut(), (*queue).counter.as_raw_fd());
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputQueue_hasEvents(queue: *mut AInputQueue) -> i32 {
    i32::from(!lock(&(*queue).waiting).is_empty())
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputQueue_getEvent(queue: *mut AInputQueue, event: *mut *mut AInputEvent) -> i32 {
    match lock(&(*queue).waiting).pop_front() {
        Some(next) => {
            looper::count_down(&(*queue).counter);
            *event = Box::into_raw(next);
            0
        }
        None => -libc::EAGAIN,
    }
}

/// Returns 0: there is no input method that would take the event first.
#[unsafe(no_mangle)]
extern "C" fn AInputQueue_preDispatchEvent(_queue: *mut AInputQueue, _event: *mut AInputEvent) -> i32 {
    0
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputQueue_finishEvent(
    queue: *mut AInputQueue,
    event: *mut AInputEvent,
    _handled: c_int,
) {
    drop(Box::from_raw(event));
    (*queue).unfinished.fetch_sub(1, Ordering::SeqCst);
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputEvent_getType(event: *const AInputEvent) -> i32 {
    match (*event).what {
        What::Motion { .. } => TYPE_MOTION,
        What::Key { .. } => TYPE_KEY,
    }
}

#[unsafe(no_mangle)]
extern "C" fn AInputEvent_getDeviceId(_event: *const AInputEvent) -> i32 {
    1
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AInputEvent_getSource(event: *const AInputEvent) -> i32 {
    match (*event).what {
        What::Motion { .. } => SOURCE_TOUCHSCREEN,
        What::Key { .. } => SOURCE_KEYBOARD,
    }
}

unsafe fn key(event: *const AInputEvent) -> (i32, i32) {
    match (*event).what {
        What::Key { action, code } => (action, code),
        What::Motion { .. } => {
            report::complain("a touch was asked for a key's properties".to_owned());
            (0, 0)
        }
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AKeyEvent_getAction(event: *const AInputEvent) -> i32 {
    key(event).0
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AKeyEvent_getKeyCode(event: *const AInputEvent) -> i32 {
    key(event).1
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getAction(event: *const AInputEvent) -> i32 {
    match (*event).what {
        What::Motion { action, .. } => action,
        What::Key { .. } => {
            report::complain("a key was asked for a touch's action".to_owned());
            action::CANCEL
        }
    }
}

unsafe fn pointers<'a>(event: *const AInputEvent) -> &'a [Pointer] {
    match &(*event).what {
        What::Motion { pointers, .. } => pointers,
        What::Key { .. } => &[],
    }
}

unsafe fn history<'a>(event: *const AInputEvent) -> &'a [Vec<Pointer>] {
    match &(*event).what {
        What::Motion { history, .. } => history,
        What::Key { .. } => &[],
    }
}

/// The pointer of an index. An index out of range would end the process on Android, so it is reported as an error of
/// the app.
fn pointer(pointers: &[Pointer], index: usize) -> Pointer {
    pointers.get(index).copied().unwrap_or_else(|| {
        report::complain(format!("pointer {index} of {} was asked for", pointers.len()));
        Pointer { id: -1, x: 0.0, y: 0.0 }
    })
}

fn along(axis: i32, pointer: Pointer) -> f32 {
    match axis {
        AXIS_X => pointer.x,
        AXIS_Y => pointer.y,
        AXIS_PRESSURE => 1.0,
        _ => 0.0,
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getPointerCount(event: *const AInputEvent) -> usize {
    pointers(event).len()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getPointerId(event: *const AInputEvent, index: usize) -> i32 {
    pointer(pointers(event), index).id
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getAxisValue(event: *const AInputEvent, axis: i32, index: usize) -> f32 {
    along(axis, pointer(pointers(event), index))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getHistorySize(event: *const AInputEvent) -> usize {
    history(event).len()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getHistoricalAxisValue(
    event: *const AInputEvent,
    axis: i32,
    index: usize,
    past: usize,
) -> f32 {
    let Some(pointers) = history(event).get(past) else {
        report::complain(format!("position {past} of {} of a batch was asked for", history(event).len()));
        return 0.0;
    };
    along(axis, pointer(pointers, index))
}

#[unsafe(no_mangle)]
unsafe extern "C" fn AMotionEvent_getHistoricalEventTime(event: *const AInputEvent, _past: usize) -> i64 {
    (*event).times.event
}

#[unsafe(no_mangle)]
extern "C" fn AMotionEvent_getToolType(_event: *const AInputEvent, _index: usize) -> i32 {
    TOOL_FINGER
}

macro_rules! axes {
    ($($now:ident $past:ident: $axis:expr;)*) => { $(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $now(event: *const AInputEvent, index: usize) -> f32 {
            AMotionEvent_getAxisValue(event, $axis, index)
        }
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $past(event: *const AInputEvent, index: usize, past: usize) -> f32 {
            AMotionEvent_getHistoricalAxisValue(event, $axis, index, past)
        }
    )* };
}
axes! {
    AMotionEvent_getX AMotionEvent_getHistoricalX: AXIS_X;
    AMotionEvent_getY AMotionEvent_getHistoricalY: AXIS_Y;
    AMotionEvent_getRawX AMotionEvent_getHistoricalRawX: AXIS_X;
    AMotionEvent_getRawY AMotionEvent_getHistoricalRawY: AXIS_Y;
    AMotionEvent_getPressure AMotionEvent_getHistoricalPressure: AXIS_PRESSURE;
}

macro_rules! constants {
    ($($name:ident = $value:expr;)*) => { $(
        #[unsafe(no_mangle)]
        extern "C" fn $name(_event: *const AInputEvent) -> i32 {
            $value
        }
    )* };
}
constants! {
    AKeyEvent_getFlags = 0;
    AKeyEvent_getMetaState = 0;
    AKeyEvent_getRepeatCount = 0;
    AKeyEvent_getScanCode = 0;
    AMotionEvent_getActionButton = 0;
    AMotionEvent_getButtonState = 0;
    AMotionEvent_getEdgeFlags = 0;
    AMotionEvent_getFlags = 0;
    AMotionEvent_getMetaState = 0;
}

macro_rules! times {
    ($($name:ident = $field:ident;)*) => { $(
        #[unsafe(no_mangle)]
        unsafe extern "C" fn $name(event: *const AInputEvent) -> i64 {
            (*event).times.$field
        }
    )* };
}
times! {
    AKeyEvent_getDownTime = down;
    AKeyEvent_getEventTime = event;
    AMotionEvent_getDownTime = down;
    AMotionEvent_getEventTime = event;
}

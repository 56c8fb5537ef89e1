//! Android's dynamic performance framework, where the system has it: thermal headroom (API 31) and performance hints
//! (API 33).

use std::{
    ffi::c_void,
    time::{Duration, Instant},
};

use crate::{ndk_late::function, thermal_budget};

/// Time between two queries of the headroom, and how far ahead it is forecast. The system answers at most once a
/// second.
const ASK: Duration = Duration::from_secs(10);

type Manager = *mut c_void;
type Session = *mut c_void;

/// The system's thermal manager (API 30; headroom from API 31).
pub struct Thermometer {
    manager: Manager,
    headroom: unsafe extern "C" fn(Manager, i32) -> f32,
    release: unsafe extern "C" fn(Manager),
    asked: Option<Instant>,
}

#[allow(unsafe_code, reason = "the NDK's C interface: types as in android/thermal.h")]
impl Thermometer {
    /// Acquires the manager; `None` where the system has none.
    pub fn new() -> Option<Self> {
        // SAFETY: the types are those of android/thermal.h.
        let (acquire, headroom, release) = unsafe {
            (
                function::<unsafe extern "C" fn() -> Manager>(c"AThermal_acquireManager")?,
                function(c"AThermal_getThermalHeadroom")?,
                function(c"AThermal_releaseManager")?,
            )
        };
        // SAFETY: the function has no preconditions.
        let manager = unsafe { acquire() };
        (!manager.is_null()).then_some(Self { manager, headroom, release, asked: None })
    }

    /// The share of the frame time that may be used; `None` until the next query is due.
    pub fn share(&mut self, now: Instant) -> Option<f32> {
        if self.asked.is_some_and(|asked| now - asked < ASK) {
            return None;
        }
        self.asked = Some(now);
        // SAFETY: the manager is acquired until `self` is dropped.
        let headroom = unsafe { (self.headroom)(self.manager, ASK.as_secs() as i32) };
        let share = thermal_budget::share(headroom);
        log::info!("thermal: headroom {headroom}, frames may take {share} of their time");
        Some(share)
    }
}

#[allow(unsafe_code, reason = "the NDK's C interface")]
impl Drop for Thermometer {
    fn drop(&mut self) {
        // SAFETY: the manager is released once, and not used afterwards.
        unsafe { (self.release)(self.manager) };
    }
}

/// A session of performance hints for the threads that render and present frames (API 33).
pub struct Hints {
    session: Session,
    report: unsafe extern "C" fn(Session, i64) -> i32,
    target: unsafe extern "C" fn(Session, i64) -> i32,
    close: unsafe extern "C" fn(Session),
    goal: Duration,
    frames: u64,
}

#[allow(unsafe_code, reason = "the NDK's C interface: types as in android/performance_hint.h")]
impl Hints {
    /// Creates a session for threads with that target frame time. `None` where the system has none.
    pub fn new(threads: &[i32], goal: Duration) -> Option<Self> {
        type Create = unsafe extern "C" fn(Manager, *const i32, usize, i64) -> Session;
        // SAFETY: the types are those of android/performance_hint.h.
        let (manager, create, report, target, close) = unsafe {
            (
                function::<unsafe extern "C" fn() -> Manager>(c"APerformanceHint_getManager")?,
                function::<Create>(c"APerformanceHint_createSession")?,
                function(c"APerformanceHint_reportActualWorkDuration")?,
                function(c"APerformanceHint_updateTargetWorkDuration")?,
                function(c"APerformanceHint_closeSession")?,
            )
        };
        // SAFETY: the manager belongs to the system; the list is read during the call only.
        let session = unsafe {
            let manager = manager();
            if manager.is_null() {
                return None;
            }
            create(manager, threads.as_ptr(), threads.len(), goal.as_nanos() as i64)
        };
        (!session.is_null()).then_some(Self { session, report, target, close, goal, frames: 0 })
    }

    /// Reports the number of timed frames and the time of the last one in milliseconds, where it is new, and the target
    /// time.
    pub fn tell(&mut self, (frames, ms): (u64, Option<f32>), goal: Duration) {
        if goal != self.goal {
            self.goal = goal;
            // SAFETY: the session is open until `self` is dropped.
            unsafe { (self.target)(self.session, goal.as_nanos() as i64) };
        }
        let took = ms.map_or(0, |ms| (ms * 1e6) as i64);
        if frames != self.frames && took > 0 {
            self.frames = frames;
            // SAFETY: the session is open until `self` is dropped.
            unsafe { (self.report)(self.session, took) };
        }
    }
}

#[allow(unsafe_code, reason = "the NDK's C interface")]
impl Drop for Hints {
    fn drop(&mut self) {
        // SAFETY: the session is closed once, and not used afterwards.
        unsafe { (self.close)(self.session) };
    }
}

/// Ids of the threads of this process that render and present frames, found by their names.
pub fn frame_threads() -> Vec<i32> {
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else { return Vec::new() };
    let makes_frames = |id: &str| {
        let name = std::fs::read_to_string(format!("/proc/self/task/{id}/comm")).unwrap_or_default();
        matches!(name.trim_end(), "glimpse-frames" | "android_main")
    };
    threads
        .flatten()
        .filter_map(|thread| thread.file_name().into_string().ok())
        .filter(|id| makes_frames(id))
        .filter_map(|id| id.parse().ok())
        .collect()
}

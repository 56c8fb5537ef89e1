//! What the system and the app tell each other about heat and frame times (Android's dynamic performance framework), where
//! the system has it: thermal headroom from API 31 on, performance hints from API 33 on.

use std::{
    ffi::c_void,
    time::{Duration, Instant},
};

use crate::{heat, ndk_late::function};

/// The system answers once a second at most, and forecasts that far.
const ASK: Duration = Duration::from_secs(10);

type Manager = *mut c_void;
type Session = *mut c_void;

/// The system's thermal manager (API 30, headroom from 31 on).
pub struct Thermometer {
    manager: Manager,
    headroom: unsafe extern "C" fn(Manager, i32) -> f32,
    release: unsafe extern "C" fn(Manager),
    asked: Option<Instant>,
}

#[allow(unsafe_code, reason = "the NDK's C interface: types as in android/thermal.h")]
impl Thermometer {
    /// `None` where the system has none.
    pub fn new() -> Option<Self> {
        // SAFETY: the types of android/thermal.h.
        let (acquire, headroom, release) = unsafe {
            (
                function::<unsafe extern "C" fn() -> Manager>(c"AThermal_acquireManager")?,
                function(c"AThermal_getThermalHeadroom")?,
                function(c"AThermal_releaseManager")?,
            )
        };
        // SAFETY: no conditions.
        let manager = unsafe { acquire() };
        (!manager.is_null()).then_some(Self { manager, headroom, release, asked: None })
    }

    /// The share of a frame's time that may be used from now on, where it is time to ask.
    pub fn share(&mut self, now: Instant) -> Option<f32> {
        if self.asked.is_some_and(|asked| now - asked < ASK) {
            return None;
        }
        self.asked = Some(now);
        // SAFETY: the manager is acquired, and released when this is dropped.
        let headroom = unsafe { (self.headroom)(self.manager, ASK.as_secs() as i32) };
        let share = heat::share(headroom);
        log::info!("thermal: headroom {headroom}, frames may take {share} of their time");
        Some(share)
    }
}

#[allow(unsafe_code, reason = "the NDK's C interface")]
impl Drop for Thermometer {
    fn drop(&mut self) {
        // SAFETY: acquired once, released once.
        unsafe { (self.release)(self.manager) };
    }
}

/// The system's performance hints for the threads that make frames (API 33).
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
    /// For these threads, whose frames may take that long. `None` where the system has none.
    pub fn new(threads: &[i32], goal: Duration) -> Option<Self> {
        type Create = unsafe extern "C" fn(Manager, *const i32, usize, i64) -> Session;
        // SAFETY: the types of android/performance_hint.h.
        let (manager, create, report, target, close) = unsafe {
            (
                function::<unsafe extern "C" fn() -> Manager>(c"APerformanceHint_getManager")?,
                function::<Create>(c"APerformanceHint_createSession")?,
                function(c"APerformanceHint_reportActualWorkDuration")?,
                function(c"APerformanceHint_updateTargetWorkDuration")?,
                function(c"APerformanceHint_closeSession")?,
            )
        };
        // SAFETY: the manager is the system's own; the list is read during the call.
        let session = unsafe {
            let manager = manager();
            if manager.is_null() {
                return None;
            }
            create(manager, threads.as_ptr(), threads.len(), goal.as_nanos() as i64)
        };
        (!session.is_null()).then_some(Self { session, report, target, close, goal, frames: 0 })
    }

    /// Tells what the last frame took, if it is new, and what the next may take.
    pub fn tell(&mut self, (frames, ms): (u64, Option<f32>), goal: Duration) {
        if goal != self.goal {
            self.goal = goal;
            // SAFETY: the session is open until this is dropped.
            unsafe { (self.target)(self.session, goal.as_nanos() as i64) };
        }
        let took = ms.map_or(0, |ms| (ms * 1e6) as i64);
        if frames != self.frames && took > 0 {
            self.frames = frames;
            // SAFETY: as above.
            unsafe { (self.report)(self.session, took) };
        }
    }
}

#[allow(unsafe_code, reason = "the NDK's C interface")]
impl Drop for Hints {
    fn drop(&mut self) {
        // SAFETY: created once, closed once.
        unsafe { (self.close)(self.session) };
    }
}

/// The threads of this process that make frames and show them, by their names.
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

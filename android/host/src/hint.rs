//! `APerformanceHint`: sessions by which the app reports frame times.

use std::ffi::{c_int, c_void};
use std::sync::Mutex;

use crate::report;
use crate::sync::lock;

/// The API level in which each symbol was introduced.
pub const SYMBOLS: &[(&str, i32)] = &[
    ("APerformanceHint_getManager", 33),
    ("APerformanceHint_createSession", 33),
    ("APerformanceHint_getPreferredUpdateRateNanos", 33),
    ("APerformanceHint_updateTargetWorkDuration", 33),
    ("APerformanceHint_reportActualWorkDuration", 33),
    ("APerformanceHint_closeSession", 33),
];

const MANAGER: *mut c_void = 0x40 as *mut c_void;

/// What the app has reported.
#[derive(Clone, Debug, Default)]
pub struct Hints {
    /// Number of open sessions.
    pub open: usize,
    /// Number of sessions created so far.
    pub created: usize,
    /// Thread ids of the last session.
    pub threads: Vec<i32>,
    /// Target time of the last session in nanoseconds.
    pub target: i64,
    /// Number of reported frame times.
    pub reports: u64,
}

static HINTS: Mutex<Hints> =
    Mutex::new(Hints { open: 0, created: 0, threads: Vec::new(), target: 0, reports: 0 });

/// What the app has reported so far.
pub fn told() -> Hints {
    lock(&HINTS).clone()
}

/// A session; only its address is used.
pub struct APerformanceHintSession {
    _number: usize,
}

#[unsafe(no_mangle)]
extern "C" fn APerformanceHint_getManager() -> *mut c_void {
    MANAGER
}

#[unsafe(no_mangle)]
extern "C" fn APerformanceHint_getPreferredUpdateRateNanos(_manager: *mut c_void) -> i64 {
    100_000_000
}

#[unsafe(no_mangle)]
unsafe extern "C" fn APerformanceHint_createSession(
    _manager: *mut c_void,
    threads: *const i32,
    count: usize,
    target: i64,
) -> *mut APerformanceHintSession {
    let threads = std::slice::from_raw_parts(threads, count);
    // As on Android, threads of other processes are refused.
    let own = |thread: &i32| std::path::Path::new(&format!("/proc/self/task/{thread}")).exists();
    if count == 0 || !threads.iter().all(own) || target <= 0 {
        report::complain(format!("APerformanceHint_createSession: threads {threads:?}, target {target} ns"));
        return std::ptr::null_mut();
    }
    let mut hints = lock(&HINTS);
    hints.open += 1;
    hints.created += 1;
    hints.threads = threads.to_vec();
    hints.target = target;
    Box::into_raw(Box::new(APerformanceHintSession { _number: hints.created }))
}

#[unsafe(no_mangle)]
extern "C" fn APerformanceHint_updateTargetWorkDuration(
    _session: *mut APerformanceHintSession,
    target: i64,
) -> c_int {
    if target <= 0 {
        report::complain(format!("APerformanceHint_updateTargetWorkDuration: {target} ns"));
        return libc::EINVAL;
    }
    lock(&HINTS).target = target;
    0
}

#[unsafe(no_mangle)]
extern "C" fn APerformanceHint_reportActualWorkDuration(
    _session: *mut APerformanceHintSession,
    duration: i64,
) -> c_int {
    if duration <= 0 {
        report::complain(format!("APerformanceHint_reportActualWorkDuration: {duration} ns"));
        return libc::EINVAL;
    }
    lock(&HINTS).reports += 1;
    0
}

#[unsafe(no_mangle)]
unsafe extern "C" fn APerformanceHint_closeSession(session: *mut APerformanceHintSession) {
    drop(Box::from_raw(session));
    lock(&HINTS).open -= 1;
}

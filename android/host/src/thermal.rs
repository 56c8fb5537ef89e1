//! `AThermal`: thermal headroom and status, set by the scenario.

use std::ffi::{c_int, c_void};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use crate::report;
use crate::sync::lock;

/// The API level in which each symbol was introduced.
pub const SYMBOLS: &[(&str, i32)] = &[
    ("AThermal_acquireManager", 30),
    ("AThermal_releaseManager", 30),
    ("AThermal_getCurrentThermalStatus", 30),
    ("AThermal_getThermalHeadroom", 31),
];

/// Android returns NaN to a query within this time after the last one (`PowerManager.getThermalHeadroom`).
const LEAST_INTERVAL: Duration = Duration::from_millis(500);
const MANAGER: *mut c_void = 0x30 as *mut c_void;

struct Thermal {
    /// Headroom; severe throttling begins at 1.
    headroom: f32,
    asked: Option<Instant>,
}

static THERMAL: Mutex<Thermal> = Mutex::new(Thermal { headroom: 0.5, asked: None });
static MANAGERS: AtomicU64 = AtomicU64::new(0);

/// Sets the headroom that the app reads.
pub fn set_headroom(headroom: f32) {
    lock(&THERMAL).headroom = headroom;
}

/// Number of managers that were acquired and not released.
pub fn managers() -> u64 {
    MANAGERS.load(Ordering::SeqCst)
}

#[unsafe(no_mangle)]
extern "C" fn AThermal_acquireManager() -> *mut c_void {
    MANAGERS.fetch_add(1, Ordering::SeqCst);
    MANAGER
}

#[unsafe(no_mangle)]
extern "C" fn AThermal_releaseManager(_manager: *mut c_void) {
    if MANAGERS.fetch_sub(1, Ordering::SeqCst) == 0 {
        report::complain("AThermal_releaseManager without a manager".to_owned());
    }
}

/// Returns `ATHERMAL_STATUS_*`: none, light, moderate or severe.
#[unsafe(no_mangle)]
extern "C" fn AThermal_getCurrentThermalStatus(_manager: *mut c_void) -> c_int {
    match lock(&THERMAL).headroom {
        h if h < 0.8 => 0,
        h if h < 0.9 => 1,
        h if h < 1.0 => 2,
        _ => 3,
    }
}

#[unsafe(no_mangle)]
extern "C" fn AThermal_getThermalHeadroom(_manager: *mut c_void, forecast_seconds: c_int) -> f32 {
    if !(0..=60).contains(&forecast_seconds) {
        report::complain(format!("AThermal_getThermalHeadroom: a forecast of {forecast_seconds} s"));
        return f32::NAN;
    }
    let mut thermal = lock(&THERMAL);
    if thermal.asked.is_some_and(|asked| asked.elapsed() < LEAST_INTERVAL) {
        return f32::NAN;
    }
    thermal.asked = Some(Instant::now());
    thermal.headroom
}

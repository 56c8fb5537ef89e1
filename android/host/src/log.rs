//! liblog.so: writes the app's log to standard error and keeps it for scenarios.

use std::collections::VecDeque;
use std::ffi::{CStr, c_char, c_int};
use std::sync::Mutex;

use crate::report;
use crate::sync::lock;

/// Number of lines that are kept; no step of a scenario writes more.
const KEPT: usize = 4096;

struct Log {
    /// Number of lines written so far.
    written: u64,
    last: VecDeque<String>,
}

static LOG: Mutex<Log> = Mutex::new(Log { written: 0, last: VecDeque::new() });

/// A mark for [`since`]: the number of the next line.
pub fn mark() -> u64 {
    lock(&LOG).written
}

/// The lines since a mark, each as `PRIORITY/TAG: TEXT`.
pub fn since(mark: u64) -> Vec<String> {
    let log = lock(&LOG);
    let first = log.written - log.last.len() as u64;
    log.last.iter().skip(mark.saturating_sub(first) as usize).cloned().collect()
}

unsafe fn write(priority: c_int, tag: *const c_char, text: *const c_char) -> c_int {
    let letter = usize::try_from(priority).ok().and_then(|n| b"??VDIWEFS".get(n)).map_or('?', |b| *b as char);
    let words = |text: *const c_char| match text.is_null() {
        true => String::new(),
        false => CStr::from_ptr(text).to_string_lossy().into_owned(),
    };
    for line in words(text).trim_end().lines() {
        let line = format!("{letter}/{}: {line}", words(tag));
        report::say_log(&line);
        if line.contains("panicked at") || line.contains("RustPanic") {
            report::complain(format!("the app panicked: {line}"));
        }
        let mut log = lock(&LOG);
        log.written += 1;
        log.last.push_back(line);
        if log.last.len() > KEPT {
            log.last.pop_front();
        }
    }
    1
}

#[unsafe(no_mangle)]
unsafe extern "C" fn __android_log_write(priority: c_int, tag: *const c_char, text: *const c_char) -> c_int {
    write(priority, tag, text)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn __android_log_buf_write(
    _buffer: c_int,
    priority: c_int,
    tag: *const c_char,
    text: *const c_char,
) -> c_int {
    write(priority, tag, text)
}

//! Emulates Android for one process: the system libraries, the Java side and the Vulkan loader that the app's library
//! needs, and scenarios that run the app.
//!
//! The dynamic linker finds this library under the names of Android's libraries (`libc.so`, `libandroid.so`, ...).
//! Symbols that it does not define are resolved by glibc.
#![allow(
    unsafe_code,
    unsafe_op_in_unsafe_fn,
    reason = "plays C interfaces: each exported function has the contract of the C function whose name it bears"
)]
#![allow(non_snake_case, reason = "the names of the C functions that are played")]

mod activity;
mod assets;
mod bionic;
mod configuration;
mod dynamic;
mod hint;
mod input;
mod java;
mod life;
mod log;
mod looper;
mod options;
mod picture;
mod process;
mod report;
mod scenario;
mod sync;
mod thermal;
mod vulkan;
mod window;

use std::ffi::{CStr, OsStr, OsString, c_char, c_int};
use std::os::unix::ffi::OsStrExt as _;

/// Runs the scenario that the command line names; returns the exit status.
///
/// # Safety
/// `arguments` must point to `count` zero-terminated strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn android_host_run(count: usize, arguments: *const *const c_char) -> c_int {
    let arguments: Vec<OsString> = std::slice::from_raw_parts(arguments, count)
        .iter()
        .map(|text| OsStr::from_bytes(CStr::from_ptr(*text).to_bytes()).to_owned())
        .collect();
    match options::Options::parse(&arguments[1..]) {
        Ok(options) => {
            report::set_slow(options.slow);
            scenario::play(options)
        }
        Err(problem) => {
            eprintln!("android-run: {problem}\n\n{}", options::USAGE);
            2
        }
    }
}

//! libc.so: the symbols that have another name or meaning in bionic than in glibc.

use std::ffi::{CStr, CString, c_char, c_int, c_long, c_void};
use std::sync::atomic::{AtomicI32, Ordering};

use crate::report;

/// The API level that is emulated.
pub static API_LEVEL: AtomicI32 = AtomicI32::new(34);

/// The API level that is emulated.
pub fn api_level() -> i32 {
    API_LEVEL.load(Ordering::Relaxed)
}

#[unsafe(no_mangle)]
extern "C" fn __errno() -> *mut c_int {
    // SAFETY: the address of a thread-local variable of this thread.
    unsafe { libc::__errno_location() }
}

/// The POSIX variant, as in bionic; glibc's symbol of this name is the GNU variant.
#[unsafe(no_mangle)]
unsafe extern "C" fn strerror_r(error: c_int, text: *mut c_char, size: usize) -> c_int {
    unsafe extern "C" {
        fn __xpg_strerror_r(error: c_int, text: *mut c_char, size: usize) -> c_int;
    }
    __xpg_strerror_r(error, text, size)
}

/// Converts bionic's numbers (`bits/sysconf.h`), which differ from glibc's.
#[unsafe(no_mangle)]
unsafe extern "C" fn sysconf(name: c_int) -> c_long {
    unsafe extern "C" {
        #[link_name = "__sysconf"]
        fn glibc_sysconf(name: c_int) -> c_long;
    }
    let name = match name {
        0x06 => libc::_SC_CLK_TCK,
        0x0b => libc::_SC_OPEN_MAX,
        0x27 | 0x28 => libc::_SC_PAGESIZE,
        0x60 => libc::_SC_NPROCESSORS_CONF,
        0x61 => libc::_SC_NPROCESSORS_ONLN,
        0x62 => libc::_SC_PHYS_PAGES,
        0x63 => libc::_SC_AVPHYS_PAGES,
        // This library's own standard library uses glibc's numbers.
        libc::_SC_PAGESIZE | libc::_SC_NPROCESSORS_ONLN => name,
        other => {
            report::complain(format!("sysconf({other:#x}) is not played"));
            return -1;
        }
    };
    glibc_sysconf(name)
}

/// The longest value of a property with its zero byte (`PROP_VALUE_MAX`).
const PROPERTY_SIZE: usize = 92;
/// The only property that is emulated.
const API_PROPERTY: &CStr = c"ro.build.version.sdk";

/// The value of a property; empty for all but one.
unsafe fn property(name: *const c_char) -> CString {
    let level = api_level().to_string();
    CString::new(if CStr::from_ptr(name) == API_PROPERTY { level } else { String::new() }).unwrap_or_default()
}

#[unsafe(no_mangle)]
unsafe extern "C" fn __system_property_get(name: *const c_char, value: *mut c_char) -> c_int {
    let text = property(name);
    let bytes = text.as_bytes_with_nul();
    debug_assert!(bytes.len() <= PROPERTY_SIZE);
    std::ptr::copy_nonoverlapping(bytes.as_ptr(), value.cast(), bytes.len());
    bytes.len() as c_int - 1
}

/// Returns the name itself as the handle of the property; null where it is unknown.
#[unsafe(no_mangle)]
unsafe extern "C" fn __system_property_find(name: *const c_char) -> *const c_char {
    if CStr::from_ptr(name) == API_PROPERTY { API_PROPERTY.as_ptr() } else { std::ptr::null() }
}

type Read = unsafe extern "C" fn(cookie: *mut c_void, name: *const c_char, value: *const c_char, serial: u32);

#[unsafe(no_mangle)]
unsafe extern "C" fn __system_property_read_callback(found: *const c_char, read: Read, cookie: *mut c_void) {
    read(cookie, found, property(found).as_ptr(), 0);
}

/// Initialises the 56 bytes of bionic's `pthread_attr_t`; glibc's function would clear 64 bytes on arm64.
#[cfg(target_arch = "aarch64")]
#[unsafe(no_mangle)]
unsafe extern "C" fn pthread_attr_init(attributes: *mut u8) -> c_int {
    type Init = unsafe extern "C" fn(*mut u8) -> c_int;
    let init = libc::dlvsym(libc::RTLD_NEXT, c"pthread_attr_init".as_ptr(), c"GLIBC_2.17".as_ptr());
    let init: Init = std::mem::transmute(init);
    let mut whole = [0u64; 8];
    let result = init(whole.as_mut_ptr().cast());
    std::ptr::copy_nonoverlapping(whole.as_ptr().cast::<u8>(), attributes, 56);
    result
}

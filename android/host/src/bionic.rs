//! libc.so: the symbols whose name or meaning differs between bionic and glibc.

use std::ffi::{CStr, c_char, c_int, c_long};
use std::sync::atomic::{AtomicI32, Ordering};

use crate::report;

/// The API level that is played.
pub static API_LEVEL: AtomicI32 = AtomicI32::new(34);

/// The API level that is played.
pub fn api_level() -> i32 {
    API_LEVEL.load(Ordering::Relaxed)
}

#[unsafe(no_mangle)]
extern "C" fn __errno() -> *mut c_int {
    // SAFETY: the address of this thread's own variable.
    unsafe { libc::__errno_location() }
}

/// bionic has the POSIX flavour; glibc's symbol of this name is GNU's.
#[unsafe(no_mangle)]
unsafe extern "C" fn strerror_r(error: c_int, text: *mut c_char, size: usize) -> c_int {
    unsafe extern "C" {
        fn __xpg_strerror_r(error: c_int, text: *mut c_char, size: usize) -> c_int;
    }
    __xpg_strerror_r(error, text, size)
}

/// bionic's numbers of what can be asked are others (bionic's `bits/sysconf.h`).
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
        // This library's own standard library asks with glibc's numbers.
        libc::_SC_PAGESIZE | libc::_SC_NPROCESSORS_ONLN => name,
        other => {
            report::complain(format!("sysconf({other:#x}) is not played"));
            return -1;
        }
    };
    glibc_sysconf(name)
}

/// Longest value of a property, with its zero byte (`PROP_VALUE_MAX`).
const PROPERTY_SIZE: usize = 92;

#[unsafe(no_mangle)]
unsafe extern "C" fn __system_property_get(name: *const c_char, value: *mut c_char) -> c_int {
    let text = match CStr::from_ptr(name).to_bytes() {
        b"ro.build.version.sdk" => api_level().to_string(),
        _ => String::new(),
    };
    let bytes = std::slice::from_raw_parts_mut(value.cast::<u8>(), PROPERTY_SIZE);
    bytes[..text.len()].copy_from_slice(text.as_bytes());
    bytes[text.len()] = 0;
    text.len() as c_int
}

/// bionic's `pthread_attr_t` has 56 bytes; glibc's has 64 on arm64 and its `pthread_attr_init` clears all of them.
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

//! Looks up NDK functions at run time that are newer than the app's oldest API level.

use std::ffi::{CStr, c_void};

/// A function of `libandroid.so`; `None` where the system does not have it.
///
/// # Safety
/// `F` must be the type of the function.
#[allow(unsafe_code, reason = "the type of a symbol is known to who asks for it alone")]
pub unsafe fn function<F: Copy>(name: &CStr) -> Option<F> {
    const { assert!(size_of::<F>() == size_of::<*mut c_void>(), "a function pointer") };
    // SAFETY: the library is loaded as long as the activity exists, and the names are zero-terminated.
    let found = unsafe {
        let library = libc::dlopen(c"libandroid.so".as_ptr(), libc::RTLD_NOW);
        if library.is_null() {
            return None;
        }
        libc::dlsym(library, name.as_ptr())
    };
    // SAFETY: the caller guarantees the type.
    (!found.is_null()).then(|| unsafe { std::mem::transmute_copy(&found) })
}

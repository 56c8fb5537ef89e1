//! Functions of the NDK that are newer than the oldest system that the app runs on: looked up when they are needed.

use std::ffi::{CStr, c_void};

/// A function of `libandroid.so`, or `None` on a system that has none of that name.
///
/// # Safety
/// `F` is the function's own type.
#[allow(unsafe_code, reason = "the type of a symbol is known to who asks for it alone")]
pub unsafe fn function<F: Copy>(name: &CStr) -> Option<F> {
    const { assert!(size_of::<F>() == size_of::<*mut c_void>(), "a function pointer") };
    // SAFETY: the library is loaded since the activity exists, and stays; the names end with a zero.
    let found = unsafe {
        let library = libc::dlopen(c"libandroid.so".as_ptr(), libc::RTLD_NOW);
        if library.is_null() {
            return None;
        }
        libc::dlsym(library, name.as_ptr())
    };
    // SAFETY: a function of that type, as the caller promises.
    (!found.is_null()).then(|| unsafe { std::mem::transmute_copy(&found) })
}

//! libdl.so: the app opens and searches libraries through here, so that an older Android can be played and the
//! Vulkan loader can be missing.

use std::cell::{Cell, RefCell};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::sync::OnceLock;

use crate::{bionic, hint, thermal, vulkan};

thread_local! {
    static PROBLEM: RefCell<Option<CString>> = const { RefCell::new(None) };
    static TOLD: Cell<bool> = const { Cell::new(false) };
}

fn fail(problem: String) -> *mut c_void {
    PROBLEM.set(CString::new(problem).ok());
    TOLD.set(false);
    std::ptr::null_mut()
}

/// glibc's own function of this name: here, the plain name means the one below.
unsafe fn glibc(name: &CStr) -> *mut c_void {
    #[cfg(target_arch = "x86_64")]
    const VERSION: &CStr = c"GLIBC_2.2.5";
    #[cfg(target_arch = "aarch64")]
    const VERSION: &CStr = c"GLIBC_2.17";
    let newer = libc::dlvsym(libc::RTLD_NEXT, name.as_ptr(), c"GLIBC_2.34".as_ptr());
    match newer.is_null() {
        true => libc::dlvsym(libc::RTLD_NEXT, name.as_ptr(), VERSION.as_ptr()),
        false => newer,
    }
}

macro_rules! glibc {
    ($name:literal as $type:ty) => {{
        static FOUND: OnceLock<usize> = OnceLock::new();
        let found = *FOUND.get_or_init(|| glibc($name) as usize);
        std::mem::transmute::<usize, $type>(found)
    }};
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dlopen(name: *const c_char, flags: c_int) -> *mut c_void {
    PROBLEM.take();
    if !name.is_null() {
        let name = CStr::from_ptr(name).to_string_lossy();
        if name.contains("libvulkan.so") && vulkan::faults::no_loader() {
            return fail(format!("dlopen failed: library \"{name}\" not found"));
        }
    }
    glibc!(c"dlopen" as unsafe extern "C" fn(*const c_char, c_int) -> *mut c_void)(name, flags)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    PROBLEM.take();
    let symbol = CStr::from_ptr(name).to_string_lossy();
    let since = thermal::SYMBOLS.iter().chain(hint::SYMBOLS).find(|(known, _)| *known == symbol);
    if since.is_some_and(|(_, level)| *level > bionic::api_level()) {
        return fail(format!("undefined symbol: {symbol}"));
    }
    glibc!(c"dlsym" as unsafe extern "C" fn(*mut c_void, *const c_char) -> *mut c_void)(handle, name)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dlerror() -> *const c_char {
    // A problem is told once, and its text stays valid until the next call.
    let own =
        PROBLEM.with_borrow(|problem| problem.as_ref().filter(|_| !TOLD.replace(true)).map(|p| p.as_ptr()));
    match own {
        Some(text) => text,
        None => glibc!(c"dlerror" as unsafe extern "C" fn() -> *const c_char)(),
    }
}

//! libdl.so: wraps `dlopen`, `dlsym` and `dlerror`, so that older API levels can be emulated and the Vulkan loader can
//! be hidden.

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

/// The functions of glibc, as the plain names refer to the wrappers below.
struct Glibc {
    dlopen: Open,
    dlsym: Find,
    dlerror: Tell,
}

type Open = unsafe extern "C" fn(*const c_char, c_int) -> *mut c_void;
type Find = unsafe extern "C" fn(*mut c_void, *const c_char) -> *mut c_void;
type Tell = unsafe extern "C" fn() -> *const c_char;

/// Looks up all functions at once, because each look-up clears the last error.
fn glibc() -> &'static Glibc {
    static FOUND: OnceLock<Glibc> = OnceLock::new();
    // SAFETY: glibc has all three functions, with these types.
    FOUND.get_or_init(|| unsafe {
        Glibc {
            dlopen: std::mem::transmute::<*mut c_void, Open>(next(c"dlopen")),
            dlsym: std::mem::transmute::<*mut c_void, Find>(next(c"dlsym")),
            dlerror: std::mem::transmute::<*mut c_void, Tell>(next(c"dlerror")),
        }
    })
}

/// The next symbol of a name after this library; glibc 2.34 moved them from libdl to libc.
unsafe fn next(name: &CStr) -> *mut c_void {
    #[cfg(target_arch = "x86_64")]
    const FIRST: &CStr = c"GLIBC_2.2.5";
    #[cfg(target_arch = "aarch64")]
    const FIRST: &CStr = c"GLIBC_2.17";
    let found =
        [c"GLIBC_2.34", FIRST].map(|version| libc::dlvsym(libc::RTLD_NEXT, name.as_ptr(), version.as_ptr()));
    if found[0].is_null() { found[1] } else { found[0] }
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
    // bionic always resolves at once; glibc needs the flag.
    (glibc().dlopen)(name, flags | libc::RTLD_NOW)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void {
    PROBLEM.take();
    let symbol = CStr::from_ptr(name).to_string_lossy();
    let since = thermal::SYMBOLS.iter().chain(hint::SYMBOLS).find(|(known, _)| *known == symbol);
    if since.is_some_and(|(_, level)| *level > bionic::api_level()) {
        return fail(format!("undefined symbol: {symbol}"));
    }
    (glibc().dlsym)(handle, name)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dlerror() -> *const c_char {
    // An error is returned once, and its text stays valid until the next call.
    let own =
        PROBLEM.with_borrow(|problem| problem.as_ref().filter(|_| !TOLD.replace(true)).map(|p| p.as_ptr()));
    match own {
        Some(text) => text,
        None => (glibc().dlerror)(),
    }
}

//! `android-run`: starts itself again with the host under the names of Android's system libraries, loads it, and
//! hands it the command line.

use std::ffi::{CStr, CString, OsString, c_char, c_int};
use std::os::unix::fs::symlink;
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The libraries that an Android app links or opens; all of them are the host.
const LIBRARIES: [&str; 6] = ["libc.so", "libm.so", "libdl.so", "liblog.so", "libandroid.so", "libvulkan.so"];
/// The host itself, beside this program.
const HOST: &str = "libglimpse_android_host.so";
/// Holds the folder of the links in the process that was started again.
const FOLDER: &str = "ANDROID_RUN_LIBRARIES";

fn main() -> ExitCode {
    let outcome = match std::env::var_os(FOLDER) {
        None => start_again(),
        Some(folder) => play(Path::new(&folder)),
    };
    match outcome {
        Ok(code) => ExitCode::from(code),
        Err(problem) => {
            eprintln!("android-run: {problem}");
            ExitCode::from(2)
        }
    }
}

/// The dynamic linker reads its search path once, when a process starts.
fn start_again() -> Result<u8, String> {
    let program = std::env::current_exe().map_err(|e| format!("cannot find itself: {e}"))?;
    let host = program.with_file_name(HOST);
    if !host.is_file() {
        return Err(format!("expected the host as {}, found nothing", host.display()));
    }
    let folder = program.with_file_name("android-libraries");
    link(&host, &folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut path = folder.clone().into_os_string();
    if let Some(rest) = std::env::var_os("LD_LIBRARY_PATH") {
        path.push(":");
        path.push(rest);
    }
    let mut again = Command::new(&program);
    again.args(std::env::args_os().skip(1)).env("LD_LIBRARY_PATH", path).env(FOLDER, &folder);
    Err(format!("{}: {}", program.display(), again.exec()))
}

fn link(host: &Path, folder: &Path) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    for name in LIBRARIES {
        let link = folder.join(name);
        if std::fs::read_link(&link).is_ok_and(|target| target == host) {
            continue;
        }
        // Another run may do the same at the same time: the link appears at once or not at all.
        let fresh = folder.join(format!("{name}.{}", std::process::id()));
        symlink(host, &fresh)?;
        std::fs::rename(&fresh, &link)?;
    }
    Ok(())
}

fn play(folder: &Path) -> Result<u8, String> {
    let library = c_path(folder.join("libandroid.so"))?;
    let arguments = std::env::args_os().map(c_path).collect::<Result<Vec<_>, _>>()?;
    let pointers: Vec<*const c_char> = arguments.iter().map(|argument| argument.as_ptr()).collect();
    // SAFETY: the host exports `android_host_run` with this very signature, and the arguments outlive the call.
    let code = unsafe {
        let handle = libc::dlopen(library.as_ptr(), libc::RTLD_NOW);
        if handle.is_null() {
            return Err(CStr::from_ptr(libc::dlerror()).to_string_lossy().into_owned());
        }
        let run = libc::dlsym(handle, c"android_host_run".as_ptr());
        if run.is_null() {
            return Err(format!("{HOST} exports no android_host_run"));
        }
        let run: extern "C" fn(usize, *const *const c_char) -> c_int = std::mem::transmute(run);
        run(pointers.len(), pointers.as_ptr())
    };
    // The app's statics are not made to be destroyed with threads of drivers still about.
    // SAFETY: ends the process at once.
    unsafe { libc::_exit(code) }
}

fn c_path(path: impl Into<PathBuf>) -> Result<CString, String> {
    let path: OsString = path.into().into();
    CString::new(path.into_encoded_bytes()).map_err(|e| format!("a zero byte in an argument: {e}"))
}

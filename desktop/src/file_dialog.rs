//! The system's own file dialog.

use std::time::{Duration, Instant};

use glimpse_shell::{DialogEnd, DialogEnded};

/// Time within which nobody cancels a dialog: one that has ended so soon, without a file, was not shown.
const NOT_SHOWN: Duration = Duration::from_millis(200);

/// Shows the dialog on a thread of its own.
pub fn open(ended: DialogEnded) {
    std::thread::spawn(move || ended(ask()));
}

fn ask() -> DialogEnd {
    if !may_exist() {
        return DialogEnd::Missing;
    }
    let began = Instant::now();
    let dialog = rfd::FileDialog::new().add_filter("glTF scenes", &["glb", "gltf"]);
    match dialog.pick_file() {
        Some(file) => DialogEnd::File(file),
        None if began.elapsed() < NOT_SHOWN => DialogEnd::Missing,
        None => DialogEnd::Cancelled,
    }
}

/// Whether the system can have a dialog: on Linux and the BSDs one of a desktop portal, which is reached by the session's
/// D-Bus, or `zenity`.
#[cfg(all(unix, not(target_os = "macos")))]
fn may_exist() -> bool {
    use std::{env, path::Path};
    let is_set = |name| env::var_os(name).is_some_and(|value| !value.is_empty());
    let bus = |folder| Path::new(&folder).join("bus").exists();
    let has_bus = is_set("DBUS_SESSION_BUS_ADDRESS") || env::var_os("XDG_RUNTIME_DIR").is_some_and(bus);
    let path = env::var_os("PATH").unwrap_or_default();
    has_bus || env::split_paths(&path).any(|folder| folder.join("zenity").is_file())
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn may_exist() -> bool {
    true
}

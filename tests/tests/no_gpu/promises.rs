//! Promises of the core to programs that embed it: no window, no thread pool, no global state.

use std::{env, fs, path::Path, process::Command};

const CORE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../core");

/// Forbidden crates, for windows, systems and thread pools. Calls of the standard library are checked by
/// Clippy (core/.clippy.toml).
const FORBIDDEN: [&str; 12] = [
    "android-activity",
    "async-std",
    "dirs",
    "egui",
    "env_logger",
    "jni",
    "ndk",
    "rayon",
    "rayon-core",
    "tempfile",
    "tokio",
    "winit",
];

#[test]
fn the_core_depends_on_no_window_system_or_thread_pool() {
    let cargo = env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
    let tree = Command::new(cargo)
        .args(["tree", "--offline", "-p", "glimpse", "--features", "flip"])
        .args(["-e", "normal", "--prefix", "none", "--format", "{p}"])
        .current_dir(CORE)
        .output()
        .expect("cargo runs");
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let tree = String::from_utf8_lossy(&tree.stdout);
    let names: Vec<_> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(names.contains(&"wgpu") && names.contains(&"glam"), "the tree is that of the core: {names:?}");
    let found: Vec<_> = FORBIDDEN.iter().filter(|name| names.contains(name)).collect();
    assert!(found.is_empty(), "the core depends on {found:?}");
}

/// Collects every Rust file below a folder with its text.
fn sources(folder: &Path, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push((path.display().to_string(), fs::read_to_string(&path).expect("UTF-8")));
        }
    }
}

/// Whether a line of Rust declares a static variable whose value can change.
fn is_global_state(line: &str) -> bool {
    let line = line.trim_start().trim_start_matches("pub ").trim_start_matches("pub(crate) ");
    let changes = ["Atomic", "Cell", "Lazy", "Lock", "Mutex", "Once"];
    let declared = line.split('=').next().unwrap_or_default();
    declared.starts_with("static ") && changes.iter().any(|kind| declared.contains(kind))
}

#[test]
fn every_feature_is_on_the_front_page() {
    let read = |file: &str| fs::read_to_string(Path::new(CORE).join(file)).expect("UTF-8");
    let manifest: toml::Table = read("Cargo.toml").parse().expect("a manifest");
    let front_page = read("src/lib.rs");
    let features = manifest["features"].as_table().expect("a table");
    assert!(features.len() > 5, "{features:?}");
    for feature in features.keys().filter(|name| *name != "default") {
        let row = front_page
            .lines()
            .find(|line| line.starts_with("//! | ") && line.contains(&format!("`{feature}`")));
        assert!(row.is_some(), "{feature}");
    }
}

#[test]
fn the_core_has_no_global_state() {
    assert!(is_global_state("    pub static CACHE: Mutex<Vec<u8>> = Mutex::new(Vec::new());"));
    assert!(!is_global_state("static NAMES: [&str; 2] = [\"Cell\", \"Mutex\"];"));
    let mut files = Vec::new();
    sources(&Path::new(CORE).join("src"), &mut files);
    assert!(files.len() > 100, "the core has more than {} files", files.len());
    for (file, text) in files {
        let library = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        let found = library.lines().find(|line| is_global_state(line));
        assert_eq!(found, None, "{file}");
    }
}

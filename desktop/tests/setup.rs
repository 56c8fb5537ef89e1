//! Runs `setup.sh` in a simulated system, where every command that would change something only logs its call.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test may fail wherever it is surprised")]

use std::{
    fs,
    os::unix::fs::{PermissionsExt, symlink},
    path::{Path, PathBuf},
    process::Command,
};

use tempfile::TempDir;

const BOOKWORM: &str = "ID=debian\nVERSION_CODENAME=bookworm\n";
const TRIXIE: &str = "ID=debian\nVERSION_CODENAME=trixie\n";
const NOBLE: &str = "ID=ubuntu\nVERSION_CODENAME=noble\n";
const MANIFEST: &str = "usr/share/vulkan/icd.d/lvp_icd.json";
const SOURCES: &str = "etc/apt/sources.list.d/glimpse-backports.sources";

/// Libraries loaded when a window opens, the Vulkan loader first.
const LIBRARIES: [&str; 6] = [
    "libvulkan.so.1",
    "libxkbcommon.so.0",
    "libxkbcommon-x11.so.0",
    "libX11-xcb.so.1",
    "libXcursor.so.1",
    "libXi.so.6",
];

/// Packages for a system that has none of them, except the driver.
const ALL: &str =
    "gcc libc6-dev g++ libvulkan1 libxkbcommon0 libxkbcommon-x11-0 libx11-xcb1 libxcursor1 libxi6 xvfb";

/// A simulated system in a folder: its files are below `root`, its commands in `bin`.
struct System {
    folder: TempDir,
}

struct Outcome {
    code: i32,
    said: String,
    /// Logged commands that would have changed something.
    ran: Vec<String>,
}

impl System {
    /// A system like a fresh container: root user, apt, nothing else.
    fn fresh(release: &str) -> Self {
        let system = Self { folder: tempfile::tempdir().unwrap() };
        system.file("etc/os-release", release);
        fs::create_dir_all(system.root().join("etc/apt/sources.list.d")).unwrap();
        fs::create_dir_all(system.folder.path().join("bin")).unwrap();
        for tool in ["sh", "grep", "tee", "env", "cat"] {
            let from = ["/usr/bin", "/bin"].map(|d| Path::new(d).join(tool));
            let from = from.iter().find(|p| p.exists()).unwrap();
            symlink(from, system.folder.path().join("bin").join(tool)).unwrap();
        }
        system.command("uname", "echo Linux");
        system.command("id", "echo 0");
        system.command("ldconfig", "true");
        system.command("dpkg-query", "exit 1");
        system.apt("");
        system.command("apt-cache", "echo ' mesa-vulkan-drivers | 25.0.7-2~bpo12+1 | http://deb/ Packages'");
        system
    }

    fn complete(release: &str) -> Self {
        let system = Self::fresh(release);
        system.command("cc", "true");
        system.command("c++", "true");
        system.command("Xvfb", "true");
        system.libraries(&LIBRARIES);
        system.file(MANIFEST, "{}");
        system
    }

    /// Sets the libraries that the linker finds.
    fn libraries(&self, names: &[&str]) {
        let lines = names.iter().map(|name| format!("echo '	{name} (libc6,x86-64) => /usr/lib/{name}'"));
        self.command("ldconfig", &lines.collect::<Vec<_>>().join("\n"));
    }

    fn root(&self) -> PathBuf {
        self.folder.path().join("root")
    }

    fn file(&self, name: &str, text: &str) {
        let path = self.root().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn remove(&self, name: &str) {
        fs::remove_file(self.root().join(name)).unwrap();
    }

    fn command(&self, name: &str, script: &str) {
        let path = self.folder.path().join("bin").join(name);
        let _ = fs::remove_file(&path);
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// Adds an apt that logs requested changes and answers a simulation with these lines.
    fn apt(&self, simulation: &str) {
        let script = format!(
            "case \"$1\" in\n-s) echo '{simulation}' ;;\n*) echo \"apt-get $*\" >>\"$RAN\"; echo 'changed' ;;\nesac"
        );
        self.command("apt-get", &script);
    }

    fn without(&self, name: &str) {
        fs::remove_file(self.folder.path().join("bin").join(name)).unwrap();
    }

    fn run(&self) -> Outcome {
        self.run_as(&[], None)
    }

    fn run_with(&self, variable: &str, value: &str) -> Outcome {
        self.run_as(&[], Some((variable, value)))
    }

    fn run_as(&self, arguments: &[&str], variable: Option<(&str, &str)>) -> Outcome {
        let ran = self.folder.path().join("ran");
        let _ = fs::remove_file(&ran);
        let mut command = Command::new("/bin/sh");
        command
            .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/setup.sh"))
            .args(arguments)
            .env_clear()
            .env("PATH", self.folder.path().join("bin"))
            .env("HOME", "/root")
            .env("RAN", &ran)
            .env("GLIMPSE_SETUP_ROOT", self.root());
        if let Some((variable, value)) = variable {
            command.env(variable, value);
        }
        let output = command.output().unwrap();
        Outcome {
            code: output.status.code().unwrap(),
            said: String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap(),
            ran: fs::read_to_string(&ran).unwrap_or_default().lines().map(str::to_owned).collect(),
        }
    }
}

fn install(packages: &str) -> String {
    format!("apt-get install -y -qq --no-install-recommends {packages}")
}

const UPDATE: &str = "apt-get update -qq";

#[test]
fn nothing_is_done_or_said_where_nothing_is_missing() {
    for release in [BOOKWORM, TRIXIE, NOBLE] {
        let outcome = System::complete(release).run();
        assert_eq!((outcome.code, outcome.said.as_str()), (0, ""));
        assert!(outcome.ran.is_empty(), "{:?}", outcome.ran);
    }
}

#[test]
fn fresh_bookworm_gets_mesa_from_backports() {
    let system = System::fresh(BOOKWORM);
    let outcome = system.run();
    assert_eq!(outcome.code, 0, "{}", outcome.said);
    let mesa = "-t bookworm-backports mesa-vulkan-drivers=25.0.7-2~bpo12+1";
    assert_eq!(outcome.ran, [UPDATE, &install(ALL), &install(mesa)]);
    let sources = fs::read_to_string(system.root().join(SOURCES)).unwrap();
    assert!(sources.contains("Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg"), "{sources}");
    for word in [
        "a C compiler",
        "a C++ compiler",
        "the Vulkan loader",
        "a Vulkan driver",
        "libraries of windows",
        "Xvfb",
    ] {
        assert!(outcome.said.contains(word), "{}", outcome.said);
    }
}

#[test]
fn backports_that_are_there_are_used() {
    let system = System::complete(BOOKWORM);
    system.remove(MANIFEST);
    system.file("etc/apt/sources.list", "deb http://deb.debian.org/debian bookworm-backports main\n");
    let outcome = system.run();
    let mesa = "-t bookworm-backports mesa-vulkan-drivers=25.0.7-2~bpo12+1";
    assert_eq!(outcome.ran, [UPDATE, &install(mesa)]);
    assert!(!system.root().join(SOURCES).exists());
}

#[test]
fn the_newest_of_backports_where_the_pinned_version_is_gone() {
    let system = System::fresh(BOOKWORM);
    system.command("apt-cache", "echo ' mesa-vulkan-drivers | 25.2.1-1~bpo12+1 | http://deb/ Packages'");
    let outcome = system.run();
    assert_eq!(outcome.code, 0, "{}", outcome.said);
    assert_eq!(outcome.ran[2], install("-t bookworm-backports mesa-vulkan-drivers"));
    assert!(outcome.said.contains("no longer"), "{}", outcome.said);
}

#[test]
fn an_old_driver_that_is_there_stays() {
    let system = System::complete(BOOKWORM);
    system.command("dpkg-query", "printf 22.3.6-1+deb12u1");
    let outcome = system.run();
    assert_eq!((outcome.code, outcome.ran.len()), (0, 0), "{}", outcome.said);
    for word in ["keeping Mesa 22.3.6-1+deb12u1", "golden frames", "--golden-driver", "25.0.7"] {
        assert!(outcome.said.contains(word), "{}", outcome.said);
    }
    assert!(!system.root().join(SOURCES).exists());
    // If the driver does not render, it is not mentioned.
    let other = system.run_with("VK_DRIVER_FILES", &system.root().join(MANIFEST).display().to_string());
    assert_eq!((other.ran.len(), other.said.as_str()), (0, ""));
    system.file("dev/dri/renderD128", "");
    let gpu = system.run();
    assert_eq!((gpu.ran.len(), gpu.said.as_str()), (0, ""));
}

#[test]
fn an_old_driver_is_replaced_where_that_is_asked_for() {
    let system = System::complete(BOOKWORM);
    system.command("dpkg-query", "printf 22.3.6-1+deb12u1");
    let outcome = system.run_as(&["--golden-driver"], None);
    let mesa = "-t bookworm-backports mesa-vulkan-drivers=25.0.7-2~bpo12+1";
    assert_eq!(outcome.ran, [UPDATE, &install(mesa)]);
    let replaced = "replaces mesa-vulkan-drivers 22.3.6-1+deb12u1 by 25.0.7-2~bpo12+1";
    assert!(outcome.said.contains(replaced), "{}", outcome.said);

    for (release, version) in [(BOOKWORM, "25.0.7-2~bpo12+1"), (TRIXIE, "25.0.7-2"), (NOBLE, "24.0.5")] {
        let system = System::complete(release);
        system.command("dpkg-query", &format!("printf {version}"));
        let outcome = system.run_as(&["--golden-driver"], None);
        assert_eq!((outcome.code, outcome.ran.len()), (0, 0), "{}", outcome.said);
        assert_eq!(outcome.said.contains("bookworm alone"), release != BOOKWORM, "{}", outcome.said);
    }
}

#[test]
fn what_changes_is_said_before_it_is_changed() {
    let system = System::fresh(BOOKWORM);
    system
        .apt("Inst libdrm2 [2.4.114-1+b1] (2.4.123-1~bpo12+1 Debian:12 [amd64])\nInst libgbm1 (25.0 Debian)");
    let outcome = system.run();
    let changed = outcome.said.find("changed").unwrap();
    for said in [
        &format!("adds the apt source {}", system.root().join(SOURCES).display()),
        &format!("installs {ALL}"),
        "installs mesa-vulkan-drivers 25.0.7-2~bpo12+1 of bookworm-backports",
    ] {
        let at = outcome.said.find(said).unwrap_or_else(|| panic!("{said:?} in {}", outcome.said));
        assert!(at < changed, "{}", outcome.said);
    }
    // The replaced packages are known only after apt has updated its lists.
    let replaces = "replaces libdrm2 2.4.114-1+b1 by 2.4.123-1~bpo12+1";
    let at = outcome.said.find(replaces).unwrap_or_else(|| panic!("{replaces:?} in {}", outcome.said));
    let before = &outcome.said[..at];
    assert_eq!(before.matches("changed").count(), 1, "the update alone comes before: {}", outcome.said);
    assert!(!outcome.said.contains("replaces libgbm1"), "{}", outcome.said);
    assert!(!outcome.said.contains("sudo"), "root needs none: {}", outcome.said);
}

#[test]
fn an_argument_that_it_does_not_know_is_refused() {
    let outcome = System::fresh(BOOKWORM).run_as(&["--golden"], None);
    assert_eq!((outcome.code, outcome.ran.len()), (2, 0));
    assert!(
        outcome.said.contains("--golden-driver") && outcome.said.contains("found --golden"),
        "{}",
        outcome.said
    );
}

#[test]
fn elsewhere_the_distributions_driver_is_taken() {
    for release in [TRIXIE, NOBLE] {
        let system = System::fresh(release);
        let outcome = system.run();
        assert_eq!(outcome.ran, [UPDATE, &install(&format!("{ALL} mesa-vulkan-drivers"))]);
        assert!(!system.root().join(SOURCES).exists());
    }
}

#[test]
fn only_what_is_missing_is_installed() {
    let system = System::complete(NOBLE);
    system.without("c++");
    assert_eq!(system.run().ran, [UPDATE, &install("g++")]);

    let system = System::complete(NOBLE);
    system.without("Xvfb");
    assert_eq!(system.run().ran, [UPDATE, &install("xvfb")]);

    for (missing, package) in LIBRARIES.iter().zip([
        "libvulkan1",
        "libxkbcommon0",
        "libxkbcommon-x11-0",
        "libx11-xcb1",
        "libxcursor1",
        "libxi6",
    ]) {
        let system = System::complete(NOBLE);
        let others: Vec<_> = LIBRARIES.into_iter().filter(|name| name != missing).collect();
        system.libraries(&others);
        assert_eq!(system.run().ran, [UPDATE, &install(package)]);
    }
}

#[test]
fn a_driver_elsewhere_counts() {
    for place in ["etc/vulkan/icd.d/nvidia_icd.json", "usr/local/share/vulkan/icd.d/my_icd.json"] {
        let system = System::complete(NOBLE);
        system.remove(MANIFEST);
        system.file(place, "{}");
        assert!(system.run().ran.is_empty(), "{place}");
    }
    for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
        let system = System::complete(NOBLE);
        system.remove(MANIFEST);
        system.file("opt/my icd.json", "{}");
        let list = format!("/nonexistent:{}", system.root().join("opt/my icd.json").display());
        assert!(system.run_with(variable, &list).ran.is_empty(), "{variable}");
        assert_eq!(system.run_with(variable, "/nonexistent").ran.len(), 2, "{variable}");
    }
}

#[test]
fn users_need_sudo() {
    let system = System::complete(NOBLE);
    system.remove(MANIFEST);
    system.command("id", "echo 1000");
    let outcome = system.run();
    assert_eq!(outcome.code, 1);
    assert!(outcome.said.contains("no sudo"), "{}", outcome.said);

    system.command("sudo", "echo \"sudo $*\" >>\"$RAN\"; \"$@\"");
    let outcome = system.run();
    assert_eq!(outcome.code, 0, "{}", outcome.said);
    assert_eq!(outcome.ran[0], format!("sudo env DEBIAN_FRONTEND=noninteractive {UPDATE}"));
    let (said, changed) = (outcome.said.find("by sudo, which may ask"), outcome.said.find("changed"));
    assert!(said.is_some() && said < changed, "{}", outcome.said);
}

#[test]
fn what_cannot_be_installed_is_said() {
    let system = System::complete("ID=arch\n");
    system.remove(MANIFEST);
    system.without("apt-get");
    let outcome = system.run();
    assert_eq!(outcome.code, 1);
    assert!(
        outcome.said.contains("no apt-get") && outcome.said.contains("a Vulkan driver"),
        "{}",
        outcome.said
    );

    let system = System::fresh(NOBLE);
    system.command("apt-get", "exit 100");
    let outcome = system.run();
    assert_eq!(outcome.code, 1);
    assert!(outcome.said.contains("that failed: apt-get update"), "{}", outcome.said);
}

#[test]
fn other_systems_bring_their_own_driver() {
    let system = System::fresh(NOBLE);
    system.command("uname", "echo Darwin");
    let outcome = system.run();
    assert_eq!((outcome.code, outcome.ran.len()), (0, 0));
    assert!(outcome.said.contains("Darwin"), "{}", outcome.said);
}

//! Tells the program what it is built from: `GLIMPSE_VERSION`, the version with the commit in parentheses where there is a
//! repository and git to ask, and `GLIMPSE_COMMIT`, that commit alone.

use std::path::Path;
use std::process::Command;

fn main() {
    for path in ["../Cargo.lock", "../app", "../core", "../desktop"] {
        println!("cargo::rerun-if-changed={path}");
    }
    let version = std::env::var("CARGO_PKG_VERSION").unwrap_or_default();
    match commit() {
        Some(commit) => {
            println!("cargo::rustc-env=GLIMPSE_COMMIT={commit}");
            println!("cargo::rustc-env=GLIMPSE_VERSION={version} ({commit})");
        }
        None => println!("cargo::rustc-env=GLIMPSE_VERSION={version}"),
    }
}

fn commit() -> Option<String> {
    // A copy inside of somebody else's repository is not that repository's commit.
    git(&["ls-files", "--error-unmatch", "build.rs"])?;
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|path| Path::new(path).exists())
    {
        println!("cargo::rerun-if-changed={log}");
    }
    git(&["describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"])
}

fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}

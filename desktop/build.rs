//! Tells the program which commit it is built from: `GLIMPSE_COMMIT`, where there is a repository and git to ask.

use std::path::Path;
use std::process::Command;

fn main() {
    for path in ["../Cargo.lock", "../app", "../core", "../desktop"] {
        println!("cargo::rerun-if-changed={path}");
    }
    // A copy inside of somebody else's repository is not that repository's commit.
    if git(&["ls-files", "--error-unmatch", "build.rs"]).is_none() {
        return;
    }
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"]).filter(|path| Path::new(path).exists())
    {
        println!("cargo::rerun-if-changed={log}");
    }
    if let Some(commit) = git(&["describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]) {
        println!("cargo::rustc-env=GLIMPSE_COMMIT={commit}");
    }
}

fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}

//! Frame tests by `glimpse check`: the golden frames of this project, and what a broken reference gives.

#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const GOLDEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden");

fn check(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_glimpse"));
    command.arg("check").args(arguments).current_dir(folder).env_remove("RUST_LOG").output().unwrap()
}

fn printed(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_golden_frames_are_as_they_were() {
    let failures = Path::new(env!("CARGO_TARGET_TMPDIR")).join("golden-failures");
    let cases = format!("{GOLDEN}/cases.toml");
    let output = check(Path::new(GOLDEN), &[&cases, "--failures", failures.to_str().unwrap()]);
    assert!(output.status.success(), "{}", printed(&output));
    assert!(output.stderr.is_empty());
}

#[test]
fn every_golden_picture_has_a_case() {
    let cases = fs::read_to_string(format!("{GOLDEN}/cases.toml")).unwrap();
    let pictures =
        fs::read_dir(GOLDEN).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    for picture in pictures.filter(|name| name.ends_with(".png")) {
        assert!(cases.contains(&format!("reference = \"{picture}\"")), "{picture}");
    }
}

/// A reference is written by a run that fails, then passes, and fails where the picture is another.
#[test]
fn references_are_written_and_differences_are_found() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let case = ["builtin:minray", "r.png", "--size", "32x24"];
    let with = |more: &[&str]| check(at, &[&case[..], more].concat());

    let missing = with(&[]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(printed(&missing).contains("FAILED  r  the reference cannot be read"), "{}", printed(&missing));
    let updated = with(&["--update"]);
    assert_eq!(updated.status.code(), Some(1));
    assert!(at.join("r.png").exists() && printed(&updated).contains("look at it"));
    let passed = with(&[]);
    assert!(passed.status.success(), "{}", printed(&passed));

    let failed = with(&["--depth", "1", "--failures", "seen", "--junit", "junit.xml"]);
    assert_eq!(failed.status.code(), Some(1));
    let text = printed(&failed);
    assert!(text.contains("--max-failed-pixels 4: found") && text.contains("see seen/r.png"), "{text}");
    assert!(at.join("seen/r.png").exists());
    assert!(fs::read_to_string(at.join("junit.xml")).unwrap().contains("failures=\"1\""));
    assert_eq!(String::from_utf8_lossy(&failed.stderr), "glimpse: error: 1 of 1 case failed\n");
}

#[test]
fn a_case_that_cannot_be_rendered_fails_and_the_others_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let case =
        |scene: &str, name: &str| format!("[[case]]\nscene = \"{scene}\"\nreference = \"{name}.png\"\n");
    let cases = format!(
        "arguments = [\"--size\", \"16x16\"]\n{}{}",
        case("gone.glb", "a"),
        case("builtin:minray", "b")
    );
    fs::write(at.join("cases.toml"), cases).unwrap();
    let output = check(at, &["cases.toml", "--update"]);
    let text = printed(&output);
    assert!(text.contains("FAILED  a") && text.contains("gone.glb") && text.contains("FAILED  b"), "{text}");
    assert!(at.join("b.png").exists() && !at.join("a.png").exists());
    let output = check(at, &["cases.toml"]);
    let text = printed(&output);
    assert!(output.status.code() == Some(1) && text.contains("passed  b"), "{text}");

    for (arguments, words) in [
        (&["cases.toml", "r.png"][..], "expected no reference"),
        (&["builtin:minray"], "expected a reference picture"),
        (&["builtin:minray", "r.png", "--max-rmse", "nan"], "--max-rmse"),
    ] {
        let output = check(at, arguments);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(words), "{told}");
    }
}

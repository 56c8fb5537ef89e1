//! Scenes on the standard input, pictures and statistics on the standard output, and what else is printed.
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use std::io::Write;
use std::process::{Command, Output, Stdio};

use glimpse::Picture;

/// A triangle, whose positions are part of the document.
const TRIANGLE: &str = r#"{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

/// Runs the program in an empty folder with the triangle on its standard input.
fn glimpse(line: &str) -> (Output, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.gltf"), TRIANGLE).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_glimpse"))
        .args(line.split_whitespace())
        .current_dir(folder.path())
        .env_remove("RUST_LOG")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that does not read closes the pipe.
    let _ = child.stdin.take().unwrap().write_all(TRIANGLE.as_bytes());
    (child.wait_with_output().unwrap(), folder)
}

fn succeeds(line: &str) -> (Output, tempfile::TempDir) {
    let (output, folder) = glimpse(line);
    assert_eq!(output.status.code(), Some(0), "{line}: {output:?}");
    (output, folder)
}

#[test]
fn a_scene_is_read_from_a_pipe_and_its_picture_written_to_one() {
    let (piped, _) = succeeds("render - -o - --size 16x9");
    let picture = Picture::decode(&piped.stdout).unwrap().into_display();
    assert_eq!(picture.dimensions(), (16, 9));
    assert!(String::from_utf8(piped.stderr).unwrap().starts_with("picture   -, 16x9, "));
    let (output, folder) = succeeds("render a.gltf -o a.png --size 16x9");
    assert!(output.stderr.is_empty(), "{output:?}");
    assert_eq!(std::fs::read(folder.path().join("a.png")).unwrap(), piped.stdout);
    let (twice, _) = succeeds("bench - - --size 8x8 --frames 1 --json");
    let json: serde_json::Value = serde_json::from_slice(&twice.stdout).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 4, "two methods on what was read once");
    let (info, _) = succeeds("info -");
    assert!(String::from_utf8(info.stdout).unwrap().contains("1 triangle"));
}

#[test]
fn statistics_go_to_a_pipe_and_the_picture_to_a_file() {
    let (output, folder) = succeeds("render a.gltf -o a.png --size 16x9 --stats -");
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["size"], serde_json::json!([16, 9]));
    assert!(folder.path().join("a.png").exists());
    let (output, _) = glimpse("render a.gltf -o - --stats -");
    let line = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0));
    assert!(line.contains("the standard output twice"), "{line}");
}

#[test]
fn the_quiet_are_told_errors_alone_and_the_verbose_every_counter() {
    let (output, _) = succeeds("render a.gltf -o a.png --size 16x9 --quiet --tau-col 0.1");
    assert!(output.stdout.is_empty() && output.stderr.is_empty(), "{output:?}");
    let (output, _) = glimpse("render gone.glb -o a.png -q");
    assert!(output.status.code() == Some(1) && !output.stderr.is_empty(), "{output:?}");
    let said = |line: &str| String::from_utf8(succeeds(line).0.stdout).unwrap();
    let (usual, verbose) =
        (said("render a.gltf -o a.png --size 16x9"), said("render a.gltf -o a.png --size 16x9 -v"));
    assert!(usual.starts_with("picture   a.png, 16x9, method adaptive"), "{usual}");
    assert!(
        !usual.contains("memory") && verbose.contains("memory") && verbose.contains("kernels   without"),
        "{verbose}"
    );
    assert!(usual.lines().count() < 6, "{usual}");
}

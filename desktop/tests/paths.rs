//! File names: those that are no text, outputs that are inputs, links, and what names do to a terminal.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test stops where it fails")]

use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use glimpse::{DisplayImage, LinearImage, to_exr, to_png};
use serde_json::json;
use tempfile::TempDir;

/// A folder with a textured triangle, its buffer and its texture in files of their own, and an environment map.
struct Scene(TempDir);

/// A name that is not UTF-8 before its ending.
fn bytes(ending: &str) -> OsString {
    OsString::from_vec([b"a\xff b", ending.as_bytes()].concat())
}

impl Scene {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let positions: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let buffer: Vec<u8> = positions.iter().flat_map(|v| v.to_le_bytes()).collect();
        let document = json!({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
            "nodes": [{"mesh": 0}, {"camera": 0, "name": "eye\u{1b}[2J\u{202e}\nlast", "translation": [0.3, 0.3, 2.0]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}],
            "images": [{"uri": "texture.png"}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}
            ],
            "bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12}],
            "buffers": [{"byteLength": 36, "uri": "buffer.png"}]
        });
        let grey = DisplayImage::from_raw(2, 2, vec![128; 16]).unwrap();
        let sky = LinearImage::from_raw(8, 4, vec![1.0; 96]).unwrap();
        let scene = Self(folder);
        scene.write("scene.gltf", document.to_string().as_bytes());
        // The ending of a picture, so that a picture can be named so.
        scene.write("buffer.png", &buffer);
        scene.write("texture.png", &to_png(&grey).unwrap());
        scene.write("sky.exr", &to_exr(&sky).unwrap());
        scene
    }

    fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: impl AsRef<Path>, bytes: &[u8]) {
        fs::write(self.path(name), bytes).unwrap();
    }

    fn run<S: AsRef<OsStr>>(&self, words: &[S]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimpse"));
        command.args(words).current_dir(self.0.path()).env_remove("RUST_LOG").output().unwrap()
    }

    fn succeeds<S: AsRef<OsStr>>(&self, words: &[S]) -> String {
        let output = self.run(words);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    }

    fn fails(&self, line: &str, words: &[&str]) {
        let output = self.run(&line.split_whitespace().collect::<Vec<_>>());
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), said.lines().count()), (Some(1), 1), "{line}: {said}");
        assert!(words.iter().all(|word| said.contains(word)), "{line}: {said}");
    }
}

#[test]
fn names_need_not_be_text() {
    let scene = Scene::new();
    let [model, picture, linear, sky, stats, plan, script, shot] =
        [".gltf", ".png", ".exr", "sky.exr", ".json", ".toml", ".script", "shot.png"].map(bytes);
    fs::rename(scene.path("scene.gltf"), scene.path(&model)).unwrap();
    fs::rename(scene.path("sky.exr"), scene.path(&sky)).unwrap();
    let words = |words: &[&OsStr]| -> Vec<OsString> {
        words.iter().copied().chain(["--size", "8x8"].map(OsStr::new)).map(OsStr::to_owned).collect()
    };
    let (render, output) = (OsStr::new("render"), OsStr::new("-o"));
    let [environment, statistics, compare, check] =
        ["--environment", "--stats", "compare", "check"].map(OsStr::new);
    scene.succeeds(&words(&[render, &model, output, &picture, environment, &sky, statistics, &stats]));
    scene.succeeds(&words(&[render, &model, output, &linear]));
    assert!([&picture, &linear, &stats].iter().all(|name| scene.path(name).is_file()));
    scene.succeeds(&[compare, &picture, &linear]);
    scene.succeeds(&[OsStr::new("info"), &model]);
    scene.succeeds(&words(&[check, &model, &picture, environment, &sky]));
    let folder = scene.path(OsStr::from_bytes(b"folder\xfe"));
    fs::create_dir(&folder).unwrap();
    for name in [model.as_os_str(), OsStr::new("buffer.png"), OsStr::new("texture.png")] {
        fs::copy(scene.path(name), folder.join(name)).unwrap();
    }
    fs::copy(scene.path(&model), folder.join("scene.gltf")).unwrap();
    fs::copy(scene.path(&linear), folder.join("linear.exr")).unwrap();
    let case = "arguments = [\"--size\", \"8x8\", \"--max-rmse\", \"1\"]\n[[case]]\nscene = \"scene.gltf\"\nreference = \"linear.exr\"\n";
    fs::write(folder.join(&plan), case).unwrap();
    scene.succeeds(&[check, folder.join(&plan).as_os_str()]);
    scene.write(&script, b"settle\nexpect problem =\nexpect primitives = 1\nexpect command contains xff\n");
    let view = ["view", "--headless", "--script"].map(OsStr::new);
    scene.succeeds(&words(&[&view[..], &[&script, &model]].concat()));
    assert!(!scene.path(&shot).exists());
}

#[test]
fn what_a_scene_is_made_of_is_no_output() {
    let scene = Scene::new();
    let render = "render scene.gltf --size 8x8 --environment sky.exr";
    for (line, name) in [
        (format!("{render} -o texture.png"), "texture.png"),
        (format!("{render} -o buffer.png"), "buffer.png"),
        (format!("{render} -o a.png --stats ./texture.png"), "texture.png"),
        (format!("{render} -o sky.exr"), "sky.exr"),
        ("check scene.gltf texture.png --size 8x8 --update".to_owned(), "texture.png"),
    ] {
        let before = fs::read(scene.path(name)).unwrap();
        let output = scene.run(&line.split_whitespace().collect::<Vec<_>>());
        let said = [output.stdout, output.stderr].concat();
        let said = String::from_utf8(said).unwrap();
        assert_eq!(output.status.code(), Some(1), "{line}: {said}");
        assert!(said.contains(&format!("{name}: the command names that file twice")), "{line}: {said}");
        assert_eq!(fs::read(scene.path(name)).unwrap(), before, "{line}");
    }
    assert!(!scene.path("a.png").exists());
    scene.write("a.script", b"settle\nscreenshot texture.png");
    scene.fails(
        "view scene.gltf --size 8x8 --headless --script a.script",
        &["texture.png: the command names that file twice"],
    );
}

#[test]
fn a_link_to_nothing_yet_is_written_through_and_a_long_name_refused_at_once() {
    let scene = Scene::new();
    std::os::unix::fs::symlink("target.png", scene.path("link.png")).unwrap();
    scene.succeeds(&["render", "scene.gltf", "-o", "link.png", "--size", "8x8"]);
    assert!(scene.path("link.png").is_symlink() && scene.path("target.png").is_file());
    let long = "a".repeat(300);
    // The scene does not exist either, which would be said first if it were read.
    scene.write("broken.glb", b"no scene");
    scene.fails(&format!("render broken.glb -o {long}.png"), &["too long"]);
    scene.fails(&format!("render broken.glb -o a.png --stats {long}"), &["too long"]);
    scene.fails(&format!("check broken.glb {long}.png --failures failed"), &["too long"]);
}

#[test]
fn names_do_not_act_on_the_terminal() {
    let scene = Scene::new();
    let rude = OsStr::from_bytes(b"\x1b[31m\xe2\x80\xaered.gltf");
    fs::copy(scene.path("scene.gltf"), scene.path(rude)).unwrap();
    let acts = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        text.contains(['\u{1b}', '\u{202e}'])
    };
    let render = ["render", "-o", "a.png", "--size", "8x8", "-vv"].map(OsStr::new);
    for words in [
        [&render[..], &[rude]].concat(),
        vec![OsStr::new("info"), rude],
        vec![OsStr::new("info"), rude, OsStr::new("--json")],
        vec![OsStr::new("compare"), rude, rude],
        vec![OsStr::new("render"), rude, rude],
        vec![OsStr::new("info"), OsStr::from_bytes(b"\x1b[31mgone.glb")],
        vec![OsStr::from_bytes(b"\x1b[31mrender")],
    ] {
        let output = scene.run(&words);
        assert!(!acts(&output.stdout) && !acts(&output.stderr), "{words:?}: {output:?}");
    }
    let text = scene.succeeds(&["info", "scene.gltf"]);
    assert!(text.lines().any(|line| line.contains(r"[2J\u{202e}") && line.contains("last")), "{text}");
    let json: serde_json::Value =
        serde_json::from_str(&scene.succeeds(&["info", "scene.gltf", "--json"])).unwrap();
    let name = json["cameras"][0]["name"].as_str().unwrap();
    assert!(name.contains("[2J\u{202e}") && name.ends_with("last"), "{name:?}");
}

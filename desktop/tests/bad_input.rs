//! Reactions of the program to bad input: one clear line, exit code 1 or 2, and no output file.
#![allow(clippy::unwrap_used, reason = "a test may fail wherever it is surprised")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use serde_json::{Value, json};
use tempfile::TempDir;

/// Exit code for failed work.
const FAILED: i32 = 1;

/// Exit code for wrong usage.
const USAGE: i32 = 2;

/// Upper bound on the length of an error message, in characters.
const LINE: usize = 600;

struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn file(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        fs::write(self.path(name), bytes).unwrap();
        self.path(name).display().to_string()
    }

    fn files(&self) -> Vec<PathBuf> {
        let mut all: Vec<_> =
            fs::read_dir(self.folder.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
        all.sort();
        all
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimpse"));
        command.args(arguments).current_dir(self.folder.path()).env_remove("RUST_LOG");
        command
    }

    /// Runs the command, which must refuse with this exit code and name each of these words.
    fn refused_with(&self, mut command: Command, code: i32, words: &[&str]) {
        let before = self.files();
        let output = command.output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        let what = format!("{command:?}\n{said}");
        assert_eq!(output.status.code(), Some(code), "{what}");
        assert_eq!(self.files(), before, "a file was left behind: {what}");
        assert!(!said.contains("panicked") && !said.contains("this is a bug"), "{what}");
        // The argument parser adds further lines with the usage.
        let line = said.lines().next().unwrap_or_default();
        assert!(code == USAGE || said.trim_end().lines().count() == 1, "more than a line: {what}");
        assert!(line.contains("error") && line.len() < LINE, "{what}");
        for word in words {
            assert!(said.to_lowercase().contains(&word.to_lowercase()), "`{word}` is not said: {what}");
        }
    }

    fn refused(&self, arguments: &[&str], code: i32, words: &[&str]) {
        self.refused_with(self.command(arguments), code, words);
    }

    fn scene_refused(&self, scene: &str, words: &[&str]) {
        self.refused(&["render", scene, "-o", "out.png", "--size", "16x16"], FAILED, words);
    }

    /// The scene is drawn without what the words name, which `--strict` refuses.
    fn scene_lacks(&self, scene: &str, words: &[&str]) {
        self.scene_rendered(scene);
        self.refused(&["render", scene, "-o", "out.png", "--size", "16x16", "--strict"], FAILED, words);
    }

    fn scene_rendered(&self, scene: &str) {
        let output = self.command(&["render", scene, "-o", "out.png", "--size", "16x16"]).output().unwrap();
        assert!(output.status.success(), "{scene}: {}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(fs::read(self.path("out.png")).unwrap()[..4], *b"\x89PNG");
        fs::remove_file(self.path("out.png")).unwrap();
    }
}

/// One triangle: the document, and its buffer of three positions and three 16-bit indices.
fn triangle() -> (Value, Vec<u8>) {
    let positions: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let mut buffer: Vec<u8> = positions.iter().flat_map(|v| v.to_le_bytes()).collect();
    buffer.extend([0_u16, 1, 2, 0].iter().flat_map(|v| v.to_le_bytes()));
    let document = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 36},
            {"buffer": 0, "byteOffset": 36, "byteLength": 6}
        ],
        "buffers": [{"byteLength": buffer.len()}]
    });
    (document, buffer)
}

fn glb(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + text.len() + 8 + buffer.len();
    let mut bytes = b"glTF".to_vec();
    for (length, kind, chunk) in [(text.len(), *b"JSON", &text[..]), (buffer.len(), *b"BIN\0", buffer)] {
        if kind == *b"JSON" {
            bytes.extend(2_u32.to_le_bytes());
            bytes.extend((total as u32).to_le_bytes());
        }
        bytes.extend((length as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

/// The valid file, from which each of the invalid ones below differs in one thing.
#[test]
fn the_triangle_itself_is_rendered() {
    let bench = Bench::new();
    let (document, buffer) = triangle();
    bench.scene_rendered(&bench.file("good.glb", glb(&document, &buffer)));
}

#[test]
fn a_scene_beyond_the_budget_of_memory() {
    let bench = Bench::new();
    let (document, buffer) = triangle();
    let scene = bench.file("good.glb", glb(&document, &buffer));
    let words = &["good.glb", "option `memory`", "are left"];
    bench.refused(&["info", &scene, "--memory", "1KiB"], FAILED, words);
    bench.refused(&["info", &scene, "--memory", "1 lot"], USAGE, &["--memory", "512MiB", "1 lot"]);
}

#[test]
fn zero_area_triangles_are_no_error() {
    let bench = Bench::new();
    let (mut document, mut buffer) = triangle();
    // A second triangle, which has no area.
    buffer.truncate(42);
    buffer.extend([0_u16, 1, 1].iter().flat_map(|v| v.to_le_bytes()));
    document["accessors"][1]["count"] = json!(6);
    document["bufferViews"][1]["byteLength"] = json!(12);
    document["buffers"][0]["byteLength"] = json!(buffer.len());
    bench.scene_rendered(&bench.file("sliver.glb", glb(&document, &buffer)));
}

#[test]
fn what_a_method_does_not_show() {
    let bench = Bench::new();
    let (mut document, buffer) = triangle();
    let transmission = json!({"KHR_materials_transmission": {"transmissionFactor": 1}});
    document["materials"] = json!([{"extensions": transmission}]);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    bench.scene_lacks(&bench.file("frosted.glb", glb(&document, &buffer)), &["rough refraction", "once"]);
}

#[test]
fn missing_file() {
    Bench::new().scene_refused("nowhere/absent.glb", &["absent.glb"]);
}

#[test]
fn not_gltf() {
    let bench = Bench::new();
    bench.scene_refused(&bench.file("text.glb", "this is no scene at all"), &["text.glb"]);
    bench.scene_refused(&bench.file("empty.glb", ""), &["empty.glb"]);
    bench.scene_refused(&bench.file("text.gltf", "{\"asset\": "), &["text.gltf"]);
    bench.scene_refused(&bench.file("picture.glb", b"\x89PNG\r\n\x1a\n0000000000000000"), &["picture.glb"]);
}

#[test]
fn a_folder_is_no_scene() {
    let bench = Bench::new();
    fs::create_dir(bench.path("folder.glb")).unwrap();
    bench.scene_refused("folder.glb", &["folder.glb"]);
}

#[cfg(unix)]
#[test]
fn a_device_is_no_scene() {
    let bench = Bench::new();
    for name in ["zero.glb", "zero.gltf"] {
        std::os::unix::fs::symlink("/dev/zero", bench.path(name)).unwrap();
        bench.scene_refused(name, &[name, "expected a file, found a pipe or a device"]);
    }
}

/// Only files in the scene's folder or below it are read, whatever exists elsewhere.
#[test]
fn what_a_scene_must_not_reach() {
    let bench = Bench::new();
    let outside = bench.file("secret.png", "secret");
    fs::create_dir(bench.path("scene")).unwrap();
    fs::create_dir(bench.path("scene/folder.png")).unwrap();
    let address = format!("file://{outside}");
    for uri in
        ["../secret.png", "%2E%2E/secret.png", &outside, &address, "http://localhost/a.png", "/dev/zero"]
    {
        let scene = bench.file("scene/textured.glb", with_image(uri));
        bench.scene_lacks(&scene, &["image 0", "cannot read", "in the scene's folder or below"]);
    }
    let scene = bench.file("scene/textured.glb", with_image("folder.png"));
    bench.scene_lacks(&scene, &["image 0", "folder.png", "found a folder"]);
}

#[test]
fn truncated_glb() {
    let bench = Bench::new();
    let (document, buffer) = triangle();
    let whole = glb(&document, &buffer);
    for length in [5, 11, 16, 60, whole.len() - 30, whole.len() - 1] {
        bench.scene_refused(&bench.file("cut.glb", &whole[..length]), &["cut.glb"]);
    }
}

#[test]
fn index_out_of_range() {
    let bench = Bench::new();
    let (document, mut buffer) = triangle();
    buffer[40] = 7;
    bench.scene_refused(&bench.file("index.glb", glb(&document, &buffer)), &["mesh", "7"]);
}

#[test]
fn references_out_of_range() {
    let bench = Bench::new();
    let places = [
        "/nodes/0/mesh",
        "/scenes/0/nodes/0",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/meshes/0/primitives/0/indices",
        "/accessors/0/bufferView",
        "/bufferViews/0/buffer",
        "/accessors/0/count",
        "/bufferViews/1/byteLength",
        "/bufferViews/1/byteOffset",
        "/buffers/0/byteLength",
    ];
    for place in places {
        let (mut document, buffer) = triangle();
        *document.pointer_mut(place).unwrap() = json!(1_000_000);
        bench.scene_refused(&bench.file("reference.glb", glb(&document, &buffer)), &["reference.glb"]);
    }
}

#[test]
fn vertices_that_are_no_numbers() {
    let bench = Bench::new();
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
        let (document, mut buffer) = triangle();
        buffer[12..16].copy_from_slice(&bad.to_le_bytes());
        bench.scene_refused(&bench.file("nan.glb", glb(&document, &buffer)), &["mesh", "position"]);
    }
}

fn with_image(uri: &str) -> Vec<u8> {
    let (mut document, buffer) = triangle();
    document["images"] = json!([{"uri": uri}]);
    document["textures"] = json!([{"source": 0}]);
    document["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    // The first two numbers of each position serve as texture coordinates.
    document["bufferViews"][0]["byteStride"] = json!(12);
    let coordinates = json!({"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"});
    document["accessors"].as_array_mut().unwrap().push(coordinates);
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    glb(&document, &buffer)
}

#[test]
fn missing_image() {
    let bench = Bench::new();
    bench.scene_lacks(&bench.file("textured.glb", with_image("absent.png")), &["absent.png"]);
}

#[test]
fn an_image_that_is_none() {
    let bench = Bench::new();
    bench.file("broken.png", "this is no picture");
    bench.scene_refused(&bench.file("textured.glb", with_image("broken.png")), &["image"]);
}

#[test]
fn unknown_required_extension() {
    let bench = Bench::new();
    let (mut document, buffer) = triangle();
    document["extensionsUsed"] = json!(["VENDOR_mesh_codec"]);
    document["extensionsRequired"] = json!(["VENDOR_mesh_codec"]);
    bench.scene_refused(&bench.file("codec.glb", glb(&document, &buffer)), &["VENDOR_mesh_codec"]);
    document.as_object_mut().unwrap().remove("extensionsRequired");
    bench.scene_rendered(&bench.file("optional.glb", glb(&document, &buffer)));
}

#[test]
fn nodes_in_a_circle() {
    let bench = Bench::new();
    let (mut document, buffer) = triangle();
    document["nodes"] = json!([{"mesh": 0, "children": [1]}, {"children": [0]}]);
    bench.scene_refused(&bench.file("circle.glb", glb(&document, &buffer)), &["node"]);
}

#[test]
fn empty_scene() {
    let bench = Bench::new();
    let (mut document, buffer) = triangle();
    document["nodes"] = json!([{"name": "nothing"}]);
    bench.scene_refused(&bench.file("empty.glb", glb(&document, &buffer)), &["empty.glb"]);
}

#[test]
fn sizes_that_cannot_be() {
    let bench = Bench::new();
    for size in ["0x0", "0x64", "64x0", "-4x4", "64", "axb", "4294967296x1", ""] {
        bench.refused(&["render", "builtin:furnace", "-o", "out.png", "--size", size], USAGE, &[]);
    }
    for size in ["4294967295x4294967295", "1000000x1000000"] {
        let arguments = ["render", "builtin:furnace", "-o", "out.png", "--size", size];
        let before = bench.files();
        let output = bench.command(&arguments).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(matches!(output.status.code(), Some(FAILED | USAGE)), "{size}: {said}");
        assert!(
            said.contains("error") && !said.contains("panicked") && !said.contains("this is a bug"),
            "{said}"
        );
        assert_eq!(bench.files(), before, "{size}");
    }
}

#[test]
fn options_that_do_not_exist() {
    let bench = Bench::new();
    let bad: [&[&str]; 28] = [
        &["--wish", "1"],
        &["--method", "magic"],
        &["--show", "everything"],
        &["--show", "check:all"],
        &["--depth", "0"],
        &["--depth", "1000000"],
        &["--t-tex", "0.6"],
        &["--t-pos", "-1"],
        &["--t-pos", "nan"],
        &["--t-pos", "inf"],
        &["--t-pos", "1e39"],
        &["--t-norm", "-1.5"],
        &["--t-norm", "NaN"],
        &["--t-gcol=-inf"],
        &["--t-gcol", "many"],
        &["--min-weight", "1.5"],
        &["--min-weight", "nan"],
        &["--frames", "0"],
        &["--frames=-1"],
        &["--frames", "100001"],
        &["--depth", "4294967296"],
        &["--block", "3"],
        &["--sampling", "0"],
        &["--sampling", "17"],
        &["--sampling", "2", "--method", "checkerboard"],
        &["--postcorrect", "maybe"],
        &["--show", "origin", "--sampling", "4"],
        &["--show", "depth", "--method", "checkerboard"],
    ];
    for options in bad {
        let arguments =
            [&["render", "builtin:furnace", "-o", "out.png", "--size", "16x16"], options].concat();
        let name = options[0].split('=').next().unwrap();
        bench.refused(&arguments, USAGE, &[name]);
    }
    bench.refused(&["render", "builtin:furnace"], USAGE, &["-o"]);
    bench.refused(&["paint"], USAGE, &["paint"]);
    bench.refused(&["report", "builtin:furnace"], USAGE, &["--output"]);
    for vary in ["block", "nonsense=1"] {
        bench.refused(&["bench", "builtin:furnace", "--vary", vary], USAGE, &["--vary", vary]);
    }
    let huge = ["--size", "16384x16384", "--sampling", "16"];
    let render = ["render", "builtin:furnace", "-o", "out.png"];
    bench.refused(&[&render[..], &huge].concat(), USAGE, &["--sampling 16", "16384x16384"]);
}

#[test]
fn an_output_that_cannot_be_written() {
    let bench = Bench::new();
    let file = bench.file("plain.txt", "not a folder");
    let inside = Path::new(&file).join("out.png").display().to_string();
    for path in ["absent/out.png", inside.as_str()] {
        let arguments = ["render", "builtin:furnace", "--size", "16x16", "-o", path];
        bench.refused(&arguments, FAILED, &["out.png"]);
        let statistics =
            [&arguments[..4], &["-o", "fine.png", "--stats", path.strip_suffix(".png").unwrap()]].concat();
        bench.refused(&statistics, FAILED, &["out"]);
    }
    fs::create_dir(bench.path("taken.png")).unwrap();
    bench.refused(
        &["render", "builtin:furnace", "--size", "16x16", "-o", "taken.png"],
        FAILED,
        &["taken.png"],
    );
}

/// Both output files are checked before the scene is read.
#[test]
fn outputs_are_checked_before_the_work() {
    let bench = Bench::new();
    // The error would be about this file if the scene were read first.
    let scene = bench.file("scene.glb", "this is no scene at all");
    let picture = bench.file("locked.png", "precious");
    let mut permissions = fs::metadata(&picture).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&picture, permissions).unwrap();
    let render = |more: &[&'static str], words: &[&str]| {
        bench.refused(&[&["render", scene.as_str(), "--size", "16x16"], more].concat(), FAILED, words);
    };
    render(&["-o", "locked.png"], &["locked.png: it is read-only"]);
    render(&["-o", "out.png", "--stats", "locked.png"], &["locked.png: it is read-only"]);
    render(&["-o", "out.png", "--stats", "out.png"], &["out.png: the command names that file twice"]);
    render(&["-o", "out.png", "--stats", "./out.png"], &["out.png: the command names that file twice"]);
    render(&["-o", "out.png", "--stats", "scene.glb"], &["scene.glb: the command names that file twice"]);
    render(&["-o", "out.png", "--stats", "."], &["it is a folder"]);
    bench.refused(
        &["report", "builtin:furnace", "-o", "locked.png"],
        FAILED,
        &["locked.png: expected a folder"],
    );
    assert_eq!(fs::read(&scene).unwrap(), b"this is no scene at all");
    assert_eq!(fs::read(&picture).unwrap(), b"precious");
    #[cfg(target_os = "linux")]
    render(&["-o", "/proc/out.png"], &["cannot write /proc/out.png"]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("scene.glb", bench.path("link.png")).unwrap();
        render(&["-o", "link.png"], &["link.png: the command names that file twice"]);
    }
}

/// An existing output file is unchanged if the work fails.
#[test]
fn a_failure_keeps_the_old_file() {
    let bench = Bench::new();
    bench.file("out.png", "precious");
    bench.scene_refused("absent.glb", &["absent.glb"]);
    assert_eq!(fs::read(bench.path("out.png")).unwrap(), b"precious");
}

#[test]
fn unknown_names() {
    let bench = Bench::new();
    let render = |scene: &'static str, more: &[&'static str]| {
        [&["render", scene, "-o", "out.png", "--size", "16x16"], more].concat()
    };
    bench.refused(&render("builtin:castle", &[]), USAGE, &["castle", "room", "cornell"]);
    bench.refused(&render("builtin:", &[]), USAGE, &["builtin:"]);
    bench.refused(&render("builtin:room", &["--camera", "backstage"]), USAGE, &["backstage"]);
    for camera in ["99", "-1", "99999999999999999999", "", "1e0", "../main"] {
        let wanted = format!("--camera={camera}");
        let arguments = ["render", "builtin:room", "-o", "out.png", "--size", "16x16", wanted.as_str()];
        bench.refused(&arguments, USAGE, &["expected a camera of the scene, which has 0 (main)"]);
    }
    bench.refused(&render("builtin:room", &["--adapter", "no such adapter"]), FAILED, &["no such adapter"]);
}

#[test]
fn no_adapter_at_all() {
    let bench = Bench::new();
    let mut command = bench.command(&["render", "builtin:furnace", "-o", "out.png", "--size", "16x16"]);
    command.env("VK_DRIVER_FILES", "/nonexistent").env("VK_ICD_FILENAMES", "/nonexistent");
    bench.refused_with(command, FAILED, &["adapter", "setup.sh"]);
}

#[test]
fn comparing_what_cannot_be_compared() {
    let bench = Bench::new();
    let text = bench.file("a.png", "this is no picture");
    bench.refused(&["compare", "absent.png", &text], FAILED, &["absent.png"]);
    bench.refused(&["compare", &text, &text], FAILED, &["a.png"]);
    bench.refused(&["compare", ".", &text], FAILED, &["found a folder"]);
    #[cfg(unix)]
    bench.refused(&["compare", "/dev/zero", &text], FAILED, &["/dev/zero", "a pipe or a device"]);
}

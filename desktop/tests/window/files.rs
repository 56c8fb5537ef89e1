//! Files dropped on the window.

use std::fs;

use serde_json::json;

use crate::harness::ScriptHarness;

/// A triangle in front of the camera.
fn glb() -> Vec<u8> {
    let mut buffer = Vec::new();
    for number in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        buffer.extend(number.to_le_bytes());
    }
    let document = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}]
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + text.len() + 8 + buffer.len();
    let mut bytes = b"glTF".to_vec();
    bytes.extend(2_u32.to_le_bytes());
    bytes.extend((total as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", text), (b"BIN\0", buffer)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

#[test]
fn a_scene_is_dropped_on_the_window() {
    let harness = ScriptHarness::with_window();
    fs::write(harness.path("good.glb"), glb()).unwrap();
    harness.plays(
        "builtin:cornell --size 64x36",
        "settle
         drop good.glb
         settle
         expect scene = good.glb
         expect primitives = 1
         open builtin:minray
         settle
         expect scene = builtin:minray",
    );
}

#[test]
fn a_wrong_file_says_why_and_leaves_the_scene() {
    let harness = ScriptHarness::with_window();
    let whole = glb();
    fs::write(harness.path("text.glb"), "this is no scene at all").unwrap();
    fs::write(harness.path("cut.glb"), &whole[..whole.len() / 2]).unwrap();
    fs::create_dir(harness.path("folder.glb")).unwrap();
    for name in ["gone.glb", "text.glb", "cut.glb", "folder.glb", "picture.png", "builtin:attic"] {
        harness.plays(
            "builtin:cornell --size 160x90",
            &format!(
                "set overlay hidden
                 settle
                 window before.png
                 drop {name}
                 settle
                 expect problem contains {name}
                 expect scene = builtin:cornell
                 key escape
                 settle
                 wait 0.5
                 settle
                 window after.png
                 lose-device
                 settle
                 expect scene = builtin:cornell
                 window again.png"
            ),
        );
        for after in ["after.png", "again.png"] {
            assert!(harness.picture("before.png") == harness.picture(after), "{name}: {after}");
        }
    }
}

#[test]
fn a_first_file_that_is_no_scene_leaves_the_room() {
    let harness = ScriptHarness::with_window();
    fs::write(harness.path("good.glb"), glb()).unwrap();
    fs::write(harness.path("bad.glb"), "nothing").unwrap();
    harness.plays(
        "bad.glb --size 64x36",
        "settle
         expect problem contains bad.glb
         expect scene = builtin:room
         drop good.glb
         settle
         expect scene = good.glb
         expect width = 64",
    );
}

#[test]
fn a_frame_that_is_not_there_is_not_saved() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:room --size 64x36",
        "screenshot none.png
         expect problem contains no frame",
    );
    assert!(!harness.path("none.png").exists());
}

#[test]
fn a_scene_is_chosen_in_the_list_of_files_where_there_is_no_dialog() {
    let harness = ScriptHarness::with_window();
    let [models, empty] = ["models", "models/empty"].map(|name| harness.path(name));
    fs::create_dir_all(&empty).unwrap();
    fs::write(models.join("good.glb"), glb()).unwrap();
    harness.plays(
        "builtin:cornell --size 320x240",
        "settle
         key ctrl+o
         settle
         expect folder != 
         key enter
         settle
         expect folder contains models
         key enter
         settle
         expect folder contains empty
         key backspace
         settle
         key down
         wait 0.1
         expect moved = 0
         key escape
         settle
         expect folder =
         key ctrl+o
         settle
         key enter
         settle
         key down
         key enter
         settle
         expect scene contains models/good.glb
         expect folder =
         expect primitives = 1
         key ctrl+o
         settle
         expect folder contains models
         key end
         key enter
         settle
         expect problem =",
    );
}

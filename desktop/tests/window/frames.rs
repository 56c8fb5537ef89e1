//! The picture in the window and the saved one equal the output of `glimpse render`.

use crate::harness::ScriptHarness;

/// Plays the script in a window of 160x90 and renders its last frame with the printed command: all three
/// pictures are equal.
fn is_rendered_again(scene: &str, script: &str) -> String {
    let harness = ScriptHarness::with_window();
    let all = format!(
        "set overlay hidden\n{script}\nsettle\nwindow window.png\nscreenshot saved.png\nprint command"
    );
    let ended = harness.plays(&format!("{scene} --size 160x90"), &all);
    let command = ended.told("command")[0].to_owned();
    let words = command.strip_prefix("glimpse ").unwrap().split_whitespace();
    let output = harness.glimpse().args(words).output().unwrap();
    assert!(output.status.success(), "{command}: {output:?}");
    let rendered = harness.picture("glimpse.png");
    assert_eq!(rendered.dimensions(), (160, 90), "{command}");
    assert!(rendered == harness.picture("saved.png"), "not what was saved: {command}");
    assert!(rendered == harness.picture("window.png"), "not what was shown: {command}");
    command
}

const ORBIT: &str = "settle\npress\nmove 0.7,0.4 over 0.3\nrelease";

#[test]
fn a_first_picture() {
    let command = is_rendered_again("builtin:minray", "");
    assert_eq!(command, "glimpse render builtin:minray -o glimpse.png --size 160x90");
}

#[test]
fn another_camera() {
    let command = is_rendered_again("builtin:cornell", ORBIT);
    for option in ["--eye", "--target", "--up", "--fov"] {
        assert!(command.contains(option), "{command}");
    }
    is_rendered_again(
        "builtin:minray",
        "settle\nmove 0.4,0.6\nscroll -4\nsettle\npress right\nmove 0.5,0.3 over 0.2\nrelease right",
    );
}

#[test]
fn a_visualisation() {
    assert!(
        is_rendered_again("builtin:cornell", &format!("set show origin\n{ORBIT}")).contains("--show origin")
    );
    is_rendered_again("builtin:cornell", "set show check:pos\nsize 64x64\nsettle\nsize 160x90");
}

#[test]
fn other_settings() {
    let all = "set method adaptive\nset block 4\nset postcorrect on\nset t-pos 0.01\nset t-norm 0.95
        set t-tex 0.1\nset t-gcol 0.05\nset depth 5\nset min-weight 0.01";
    let command = is_rendered_again("builtin:cornell", all);
    assert_eq!(command.matches("--").count(), 9, "{command}");
    is_rendered_again("builtin:cornell", "set sampling 2\nset block 8");
    is_rendered_again("builtin:cornell", "set method checkerboard");
    is_rendered_again("builtin:cornell", "set method full");
}

/// Pixels kept from before the camera came to rest are renewed until none is left.
#[test]
fn frames_that_are_kept() {
    for method in ["frameless", "reproject"] {
        let command = is_rendered_again(
            "builtin:cornell",
            &format!("set method {method}\nset refresh-fraction 0.2\n{ORBIT}"),
        );
        assert!(
            command.contains(&format!("--method={method}")) && command.contains("--refresh-fraction=0.2"),
            "{command}"
        );
    }
}

#[test]
fn a_view_at_rest_is_refined_after_its_frame_was_counted() {
    let harness = ScriptHarness::headless();
    harness.plays(
        "builtin:cornell --size 64x36",
        "settle
         screenshot chosen.png
         expect rt_ratio < 1
         set at-rest refined
         settle
         expect command contains --supersample=true --preset=refined
         expect rt_ratio < 1
         screenshot refined.png",
    );
    let mut render = harness.glimpse();
    render.args("render builtin:cornell --size 64x36 --supersample --preset refined -o r.png".split(' '));
    assert!(render.output().unwrap().status.success());
    assert!(harness.picture("refined.png") == harness.picture("r.png"));
    assert!(harness.picture("refined.png") != harness.picture("chosen.png"));
}

//! Life cycle events of a window and a phone, after each of which the picture comes back.

use crate::harness::ScriptHarness;

/// Plays events between two pictures of a window of 160x90, which must be equal.
fn comes_back(script: &str) {
    let harness = ScriptHarness::with_window();
    let all = format!("set overlay hidden\nsettle\nwindow before.png\n{script}\nwindow after.png");
    harness.plays("builtin:cornell --size 160x90", &all);
    assert!(harness.picture("before.png") == harness.picture("after.png"), "{script}");
}

#[test]
fn from_any_size() {
    comes_back(
        "size 1x1
         settle
         expect width = 1
         expect height = 1
         size 1x300
         settle
         expect height = 300
         size 640x1
         settle
         expect width = 640
         size 333x257
         settle
         expect view_width = 333
         size 160x90
         settle",
    );
}

/// Each step after an event takes one frame.
#[test]
fn within_two_frames_after_a_pause_or_a_lost_surface() {
    comes_back("pause\nwait 0.5\nexpect view_width = 160\nresume\nwait 0");
    comes_back("pause\nresume\nwait 0");
    comes_back("lose-surface\nwait 0");
    comes_back("pause\nlose-surface\nwait 0.1\nresume\nwait 0");
}

#[test]
fn after_a_lost_device() {
    comes_back("lose-device\nsettle");
    comes_back("pause\nlose-device\nwait 0.1\nresume\nsettle");
    comes_back("lose-device\nwait 0.5\nlose-device\nlose-surface\nsettle");
    comes_back("press\nmove 0.6,0.5 over 0.1\nlose-device\nwait 0.1\nrelease\nkey r\nsettle");
}

/// The overlay's fonts are restored on the new device as well.
#[test]
fn with_its_overlay() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:cornell --size 640x360",
        "set overlay full
         settle
         wait 1
         window before.png
         lose-device
         settle
         wait 1
         window after.png
         set overlay hidden
         settle
         window without.png",
    );
    let [before, after, without] =
        ["before", "after", "without"].map(|name| harness.picture(&format!("{name}.png")));
    assert!(before == after && before != without);
}

#[test]
fn from_an_icon_and_from_the_full_screen() {
    comes_back("minimise\nwait 0.2\nrestore\nwait 0.2\nsettle");
    comes_back("fullscreen on\nwait 0.2\nfullscreen off\nwait 0.2\nsettle");
}

#[test]
fn a_device_that_is_lost_again_and_again_is_given_up() {
    let harness = ScriptHarness::with_window();
    let lost = "lose-device\nwait 0.05\n".repeat(4);
    harness.plays(
        "builtin:cornell --size 64x36",
        &format!("settle\n{lost}settle\nexpect scene = builtin:cornell\nexpect width = 64"),
    );
}

#[test]
fn scarce_memory_halves_the_picture() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:cornell --size 160x90",
        "set split 0.5
         settle
         expect width = 160
         low-memory
         settle
         expect width = 80
         expect height = 45
         expect view_width = 160",
    );
}

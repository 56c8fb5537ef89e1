//! User input in the window, and its effects.

use crate::harness::ScriptHarness;

#[test]
fn a_window_shows_its_first_picture() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:cornell --size 160x90",
        "set overlay hidden
         settle
         expect width = 160
         expect height = 90
         expect scene = builtin:cornell
         expect primitives > 0
         expect rays > 0
         expect rt_ratio < 1
         expect moved = 0
         window first.png",
    );
    let picture = harness.picture("first.png");
    assert_eq!(picture.dimensions(), (160, 90));
    let colors: std::collections::HashSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colors.len() > 500, "{} colours", colors.len());
}

#[test]
fn dragging_turns_and_the_wheel_moves_the_camera() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:cornell --size 160x90",
        "set overlay hidden
         settle
         window before.png
         press
         move 0.7,0.4 over 0.3
         release
         settle
         expect moved = 1
         window turned.png
         scroll 3
         settle
         window nearer.png
         key r
         settle
         window back.png",
    );
    let [before, turned, nearer, back] =
        ["before", "turned", "nearer", "back"].map(|name| harness.picture(&format!("{name}.png")));
    assert!(before != turned && turned != nearer);
    assert_eq!(before, back);
}

#[test]
fn a_pinch_and_fingers_move_the_camera() {
    let harness = ScriptHarness::with_window();
    for fingers in [
        "touch 0 begin 0.4,0.5\ntouch 0 move 0.6,0.5 over 0.2\ntouch 0 end",
        "touch 0 begin 0.4,0.5\ntouch 1 begin 0.6,0.5\ntouch 1 move 0.8,0.5 over 0.2\ntouch 1 end\ntouch 0 end",
        "move 0.5,0.5\npinch 1.5",
    ] {
        harness.plays(
            "builtin:cornell --size 64x36",
            &format!("settle\nexpect moved = 0\n{fingers}\nsettle\nexpect moved = 1"),
        );
    }
}

#[test]
fn a_double_click_puts_what_was_hit_into_the_middle() {
    let harness = ScriptHarness::with_window();
    let ended = harness.plays(
        "builtin:cornell --size 160x90",
        "settle
         move 0.4,0.7
         press
         release
         press
         release
         settle
         expect moved = 1
         print command",
    );
    assert!(ended.told("command")[0].contains("--target="), "{:?}", ended.stdout);
}

#[test]
fn keys_and_sliders_choose() {
    let harness = ScriptHarness::with_window();
    harness.plays(
        "builtin:cornell --size 64x36",
        "settle
         key b
         expect block = 4
         key m
         expect method = checkerboard
         set method full
         key v
         expect show = origin
         settle
         expect legend contains traced
         key x
         expect split = 0.5
         key x
         key 3
         settle
         expect scene = builtin:minray
         key ctrl+c
         wait 0.1
         expect notice contains clipboard
         hold n
         let n
         key f1
         wait 0.2
         key escape",
    );
    // The slider of the first tolerance in the panel at the right; the window is high enough for all sliders.
    harness.plays(
        "builtin:minray --size 1280x1700",
        "set governor off
         set scale 0.125
         set overlay full
         settle
         move 0.8125,0.8577
         press
         move 0.9,0.8577 over 0.2
         release
         settle
         expect command contains --t-pos=",
    );
}

#[test]
fn the_divider_of_a_split_view_is_dragged() {
    let harness = ScriptHarness::with_window();
    let script = "set overlay brief
         set split 0.5
         settle
         expect psnr > 30
         move 0.5,0.5
         press
         move 0.8,0.5 over 0.2
         release
         settle
         expect split > 0.75
         expect split < 0.85
         expect moved = 0";
    harness.plays("builtin:cornell --size 640x360", script);
    let equal = "set split 0.5\nset method full\nsettle\nexpect psnr = inf";
    harness.plays("builtin:cornell --size 64x36", equal);
    let grids = "set sampling 2\nset split 0.5\nsettle\nexpect psnr > 20\nset scale 0.5\nset governor off\nsettle\nexpect width = 80";
    harness.plays("builtin:cornell --size 160x90", grids);
}

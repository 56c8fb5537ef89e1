//! Tests of scripts: their errors, and that results are the same each time, with and without a window.

use crate::harness::ScriptHarness;

#[test]
fn what_is_not_met_fails_with_its_line() {
    for harness in [ScriptHarness::with_window(), ScriptHarness::headless()] {
        let view = "builtin:cornell --size 64x36";
        let line = harness.fails(view, "settle\n\nexpect width = 65", 1);
        assert_eq!(line, "a.script:3: expected width = 65, found 64");
        let line = harness.fails(view, "settle\nset method checkerboard\nset sampling 2", 1);
        assert!(line.starts_with("a.script:3: "), "{line}");
        let line = harness.fails(view, "settle\nprint cats", 1);
        assert_eq!(line, "a.script:2: expected the name of a value, found `cats`");
        let line = harness.fails(view, "print command\nsettle", 1);
        assert_eq!(line, "a.script:1: expected a value of command, found none yet");
        let line = harness.fails(view, "settle\nscreenshot gone/a.png\nwait 1", 1);
        assert!(line.contains("gone/a.png"), "{line}");
        let line = harness.fails(view, "settle\npause\nwindow a.png\nwait 0.1", 1);
        assert_eq!(line, "a.png: expected a window to save, found none");
    }
}

#[test]
fn a_frame_is_compared_with_a_picture_within_bounds() {
    let harness = ScriptHarness::headless();
    let view = "builtin:cornell --size 64x36";
    let expected = "settle\nexpect picture my reference.png";
    let line = harness.fails(view, expected, 1);
    assert!(line.starts_with("a.script:2: cannot read my reference.png: "), "{line}");
    harness.plays(view, "settle\nscreenshot my reference.png");
    harness.plays(view, expected);
    harness.plays(view, &format!("{expected} --max-rmse 0 --max-failed-pixels 0"));
    let other = "settle\nset method full\nset show depth\nexpect picture my reference.png";
    let line = harness.fails(view, &format!("{other} --max-rmse 1"), 1);
    assert!(line.starts_with("a.script:4: the frame against my reference.png: --max-rmse 1: "), "{line}");
    harness.plays(view, &format!("{other} --max-rmse 255"));
    let line = harness.fails(view, "set depth 2\nexpect picture my reference.png --max-rsme 3", 1);
    assert!(line.contains("a.script:2: ") && line.contains("'--max-rmse'"), "{line}");
    let line = harness.fails("builtin:cornell --size 32x18", expected, 1);
    assert!(line.contains("my reference.png: ") && line.contains("32x18 and 64x36"), "{line}");
}

#[test]
fn a_window_opens_with_the_options_of_render() {
    let harness = ScriptHarness::headless();
    let chosen = "expect method = full\nexpect depth = 2\nexpect show = depth\nexpect samples = 64";
    harness.plays(
        "builtin:cornell --size 64x36 --method full --depth 2 --show depth --eye 1,2,3 --target 0,0,0",
        &format!("settle\n{chosen}\nexpect moved = 1\nexpect command contains --eye=1,2,3"),
    );
    harness.plays(
        "builtin:cornell --size 64x36 --camera 0 --method path --samples 3",
        "settle\nexpect samples = 3\nexpect depth = 64\nexpect moved = 0",
    );
    for (options, expected) in [
        ("--depth 0", "--depth 0: expected a whole number"),
        ("--show attr:col", "--show attr:col: "),
        ("--supersample --focus box", "--focus box: expected indices"),
    ] {
        let line = harness.fails(&format!("builtin:cornell --size 64x36 {options}"), "settle", 2);
        assert!(line.contains(expected), "{line}");
    }
}

/// Without a display a window could not be opened.
#[test]
fn a_malformed_line_is_refused_before_there_is_a_window() {
    let harness = ScriptHarness::with_window();
    let line = harness.fails("builtin:cornell", "settle\ndance", 1);
    assert_eq!(line, "a.script:2: expected a step, found `dance`");
}

/// Motion, the governor with a fixed cost, heat, window sizes, and another scene.
const MUCH: &str = "set overlay hidden
    set governor 30
    cost 900
    settle
    screenshot 1.png
    press
    move 0.8,0.3 over 0.5
    window 2.png
    thermal 0.5
    move 0.2,0.6 over 0.5
    window 3.png
    screenshot 4.png
    release
    window 5.png
    settle
    size 100x70
    set show depth
    settle
    window 6.png
    open builtin:minray
    set show final
    settle
    screenshot 7.png";

#[test]
fn pictures_are_the_same_every_time_and_without_a_window() {
    let stages = [ScriptHarness::with_window(), ScriptHarness::with_window(), ScriptHarness::headless()];
    for harness in &stages {
        harness.plays("builtin:cornell --size 160x90", MUCH);
    }
    for picture in 1..=7 {
        let name = format!("{picture}.png");
        let [first, again, headless] =
            [0, 1, 2].map(|i: usize| std::fs::read(stages[i].path(&name)).unwrap());
        assert!(first == again, "{name} differs the second time");
        assert!(first == headless, "{name} differs without a window");
    }
}

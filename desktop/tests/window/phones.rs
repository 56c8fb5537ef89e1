//! Emulation of every phone.

use crate::harness::ScriptHarness;

/// Names of the phones as listed by the program.
fn names(harness: &ScriptHarness) -> Vec<String> {
    let line = harness.fails("builtin:cornell --phone nothing", "settle", 2);
    let names = line.split("[possible values: ").nth(1).unwrap().split(']').next().unwrap();
    names.split(", ").map(str::to_owned).collect()
}

#[test]
fn each_starts_and_is_turned() {
    let harness = ScriptHarness::headless();
    let names = names(&harness);
    assert!(names.len() >= 5, "{names:?}");
    for name in names {
        let ended = harness.plays(
            &format!("builtin:minray --phone {name}"),
            "set governor off
             set scale 0.125
             settle
             print view_width
             print view_height
             print width
             rotate
             settle
             print view_width
             print view_height",
        );
        let [widths, heights] = ["view_width", "view_height"].map(|side| ended.told(side));
        assert_eq!((widths[0], heights[0]), (heights[1], widths[1]), "{name}");
        let [width, height, frame] =
            [widths[0], heights[0], ended.told("width")[0]].map(|t| t.parse::<f64>().unwrap());
        assert!(
            height > 1.5 * width && (width / 8.0 - frame).abs() <= 1.0,
            "{name}: {width}x{height}, {frame}"
        );
    }
}

#[test]
fn one_is_a_window_that_fits_the_screen() {
    let harness = ScriptHarness::with_window();
    let phone = names(&harness).remove(0);
    harness.plays(
        &format!("builtin:minray --phone {phone}"),
        "set governor off
         set scale 0.125
         settle
         window upright.png
         rotate
         settle
         window turned.png
         touch 0 begin 0.4,0.5
         touch 0 move 0.6,0.5 over 0.2
         touch 0 end
         settle
         expect moved = 1",
    );
    let [upright, turned] = ["upright.png", "turned.png"].map(|name| harness.picture(name).dimensions());
    assert_eq!(upright, (turned.1, turned.0));
    assert!(upright.0 < upright.1 && upright.1 <= 1600, "{upright:?}");
}

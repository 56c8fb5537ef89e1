//! The governor in the program itself, on a device that heats up and cools down.

use crate::harness::ScriptHarness;

/// Factors on the time limit of a frame, four seconds each: heat as in stress tests of phones, in steps of
/// their clocks.
const HEAT: [f64; 9] = [1.0, 0.9, 0.8, 0.72, 0.6, 0.5, 0.72, 0.9, 1.0];

#[test]
fn frames_stay_within_their_time_while_the_device_gets_hot() {
    let harness = ScriptHarness::with_window();
    // A full frame at the best level takes 1.3 times the limit.
    let mut script = "settle\ncost 752\nset governor 30\npress\n".to_owned();
    for (step, heat) in HEAT.iter().enumerate() {
        let x = if step % 2 == 0 { 0.9 } else { 0.1 };
        script += &format!("thermal {heat}\nmove {x},0.5 over 4\n");
    }
    script += "release\nprint frames\nprint late\n";
    let ended = harness.plays("builtin:minray --size 320x180", &script);
    let [frames, late] = ["frames", "late"].map(|name| ended.told(name)[0].parse::<f64>().unwrap());
    assert!(frames > 1500.0, "{frames} frames");
    assert!(late <= 0.01 * frames, "{late} of {frames} frames are late");
}

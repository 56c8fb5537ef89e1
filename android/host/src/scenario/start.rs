//! The app starts and shows its picture.

use super::Outcome;
use super::harness::Harness;
use crate::{activity, java, vulkan};
use std::time::Duration;

/// At rest, the overlay's clocks may still want a picture now and then.
const RESTING: u64 = 10;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let expected = harness.expected()?;
    harness.step("created, started, resumed, with a window", |harness| {
        let intent = harness.intent();
        harness.launch(intent);
        Ok(())
    })?;
    harness.step("the expected picture is presented, pixel for pixel", |harness| harness.shows(&expected))?;
    harness.step("it stays", |harness| {
        let rest = harness.rest()?;
        rest.difference(&expected).map_or(Ok(()), Err)
    })?;
    harness.step("a picture with one other pixel is not taken for it", |harness| {
        let mut other = (*expected).clone();
        other.rgb.iter_mut().rev().take(1).for_each(|channel| *channel ^= 1);
        let found = harness.rest()?.difference(&other);
        let all = expected.width * expected.height;
        match found == Some(format!("1 of {all} pixels differ, by 1 of 255 at most")) {
            true => Ok(()),
            false => Err(format!("expected 1 of {all} pixels to differ, found {found:?}")),
        }
    })?;
    harness.step("a picture at rest is not presented again and again", |harness| {
        let before = vulkan::presents();
        harness.wait(Duration::from_secs(2));
        match vulkan::presents() - before {
            few @ 0..=RESTING => Ok(few),
            many => Err(format!("expected {RESTING} presents in 2 s at most, found {many}")),
        }
    })?;
    harness.step("the screen was kept on, the system's bars are hidden", |_| {
        let (flags, bars) = (activity::window_flags(), java::with_world(|world| world.system_ui));
        match flags & activity::KEEP_SCREEN_ON != 0 && bars != 0 {
            true => Ok(()),
            false => Err(format!("expected KEEP_SCREEN_ON and hidden bars, found {flags:#x} and {bars:#x}")),
        }
    })?;
    harness.step("destroyed", |harness| {
        harness.destroy()?;
        harness.no_threads()
    })
}

//! To the background and back, in the ways that Android has.

use super::Outcome;
use super::harness::Harness;
use crate::picture::Picture;
use crate::vulkan;

/// How often everything is played.
const ROUNDS: usize = 3;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let expected = harness.opens()?;
    // One for frames and, on a processor, one that compiles kernels.
    let devices = vulkan::devices_created();
    for _ in 0..ROUNDS {
        harness.step("the window goes and comes: a correct picture within two presents", |harness| {
            harness.rest()?;
            harness.with(|activity| {
                activity.pause();
                activity.destroy_window();
            });
            comes_back(harness, &expected)
        })?;
        harness.step("stopped with its state saved, low memory, started again", |harness| {
            harness.with(|activity| {
                activity.focus(false);
                activity.pause();
                activity.save();
                activity.stop();
                activity.destroy_window();
                activity.low_memory();
            });
            harness.wait(std::time::Duration::from_millis(300));
            harness.with(|activity| activity.start());
            comes_back(harness, &expected)
        })?;
        harness.step("paused behind a dialogue, the window stays", |harness| {
            let first = vulkan::presents();
            harness.with(|activity| {
                activity.focus(false);
                activity.pause();
                activity.resume();
                activity.focus(true);
                activity.redraw();
            });
            harness.shows_within_two(first, &expected)
        })?;
        harness.step("low memory in the foreground", |harness| {
            harness.with(|activity| activity.low_memory());
            harness.rest()?.difference(&expected).map_or(Ok(()), Err)
        })?;
    }
    harness.step("the devices of the first window served all", |_| match vulkan::devices_created() {
        found if found == devices => Ok(()),
        found => Err(format!("expected {devices} devices, found {found}")),
    })
}

/// Resumes with a new window, in the order that Android has.
fn comes_back(harness: &mut Harness, expected: &Picture) -> Outcome {
    let (first, size) = (vulkan::presents(), harness.size);
    harness.with(|activity| {
        activity.resume();
        activity.create_window(size);
        activity.focus(true);
    });
    harness.shows_within_two(first, expected)
}

//! To the background and back, in the ways that Android has.

use super::Outcome;
use super::harness::Stage;
use crate::picture::Picture;
use crate::vulkan;

/// How often everything is played.
const ROUNDS: usize = 3;

/// Plays it.
pub fn play(stage: &mut Stage) -> Outcome {
    let expected = stage.opens()?;
    for _ in 0..ROUNDS {
        stage.step("the window goes and comes: a correct picture within two presents", |stage| {
            stage.rest()?;
            stage.with(|activity| {
                activity.pause();
                activity.destroy_window();
            });
            comes_back(stage, &expected)
        })?;
        stage.step("stopped with its state saved, low memory, started again", |stage| {
            stage.with(|activity| {
                activity.focus(false);
                activity.pause();
                activity.save();
                activity.stop();
                activity.destroy_window();
                activity.low_memory();
            });
            stage.wait(std::time::Duration::from_millis(300));
            stage.with(|activity| activity.start());
            comes_back(stage, &expected)
        })?;
        stage.step("paused behind a dialogue, the window stays", |stage| {
            let first = vulkan::presents();
            stage.with(|activity| {
                activity.focus(false);
                activity.pause();
                activity.resume();
                activity.focus(true);
                activity.redraw();
            });
            stage.shows_within_two(first, &expected)
        })?;
        stage.step("low memory in the foreground", |stage| {
            stage.with(|activity| activity.low_memory());
            stage.rest()?.difference(&expected).map_or(Ok(()), Err)
        })?;
    }
    stage.step("one device served all windows", |_| match vulkan::devices_created() {
        1 => Ok(()),
        other => Err(format!("expected 1 device, found {other}")),
    })
}

/// Resumes with a new window, in the order that Android has.
fn comes_back(stage: &mut Stage, expected: &Picture) -> Outcome {
    let (first, size) = (vulkan::presents(), stage.size);
    stage.with(|activity| {
        activity.resume();
        activity.create_window(size);
        activity.focus(true);
    });
    stage.shows_within_two(first, expected)
}

//! Activities come and go in one process.

use std::time::Duration;

use super::Outcome;
use super::harness::{Harness, destroy};
use crate::{java, process, vulkan, window};

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let expected = harness.expected()?;
    let mut descriptors = Vec::new();
    for round in 0..3 {
        harness.step("created, the expected picture, destroyed, no thread left", |harness| {
            let intent = harness.intent();
            harness.launch(intent);
            harness.shows(&expected)?;
            harness.destroy()?;
            harness.no_threads()
        })?;
        if round == 0 {
            descriptors = process::descriptors();
        }
    }
    harness.step("destroyed without ever having a window", |harness| {
        let intent = harness.intent();
        harness.create(intent, &[]);
        harness.with(|activity| {
            activity.start();
            activity.resume();
        });
        harness.wait(Duration::from_millis(200));
        harness.destroy()?;
        harness.no_threads()
    })?;
    for delay in [0, 50, 500] {
        harness.step("destroyed while it loads", |harness| {
            let intent = harness.intent();
            harness.launch(intent);
            harness.wait(Duration::from_millis(delay));
            harness.destroy()?;
            harness.no_threads()
        })?;
    }
    harness.step("a second activity is created while the first is stopped", |harness| {
        let intent = harness.intent();
        harness.launch(intent);
        harness.shows(&expected)?;
        harness.with(|first| {
            first.focus(false);
            first.pause();
            first.destroy_window();
            first.stop();
        });
        let first = harness.activity.take();
        let intent = harness.intent();
        harness.launch(intent);
        harness.shows(&expected)?;
        if let Some(first) = first {
            destroy(first)?;
        }
        let presents = vulkan::presents();
        harness.with(|second| second.redraw());
        harness.shows_within_two(presents, &expected)?;
        harness.destroy()?;
        harness.no_threads()
    })?;
    harness.step("what was saved comes back", |harness| {
        let intent = harness.intent();
        harness.launch(intent);
        harness.shows(&expected)?;
        let mut saved = Vec::new();
        harness.with(|activity| saved = activity.save());
        harness.destroy()?;
        let intent = harness.intent();
        harness.create(intent, &saved);
        let size = harness.size;
        harness.with(|activity| {
            activity.start();
            activity.resume();
            activity.create_window(size);
            activity.focus(true);
        });
        harness.shows(&expected)?;
        harness.destroy()?;
        harness.no_threads()
    })?;
    harness.step("nothing is held: descriptors, windows, devices, local references", |_| {
        let found = process::descriptors();
        let [devices, surfaces] = vulkan::alive();
        let [local, _, _] = java::references();
        let held = [window::held(), devices, surfaces, local];
        match found.len() <= descriptors.len() && held == [0; 4] {
            true => Ok(()),
            false => Err(format!(
                "expected {descriptors:?} and no windows, devices, surfaces, local references; \
                 found {found:?} and {held:?}"
            )),
        }
    })
}

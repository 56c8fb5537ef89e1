//! Activities come and go in one process.

use std::time::Duration;

use super::Outcome;
use super::harness::{Stage, destroy};
use crate::{java, process, vulkan, window};

/// Plays it.
pub fn play(stage: &mut Stage) -> Outcome {
    let expected = stage.expected()?;
    let mut descriptors = Vec::new();
    for round in 0..3 {
        stage.step("created, the expected picture, destroyed, no thread left", |stage| {
            let intent = stage.intent();
            stage.launch(intent);
            stage.shows(&expected)?;
            stage.destroy()?;
            stage.no_threads()
        })?;
        if round == 0 {
            descriptors = process::descriptors();
        }
    }
    stage.step("destroyed without ever having a window", |stage| {
        let intent = stage.intent();
        stage.create(intent, &[]);
        stage.with(|activity| {
            activity.start();
            activity.resume();
        });
        stage.wait(Duration::from_millis(200));
        stage.destroy()?;
        stage.no_threads()
    })?;
    for delay in [0, 50, 500] {
        stage.step("destroyed while it loads", |stage| {
            let intent = stage.intent();
            stage.launch(intent);
            stage.wait(Duration::from_millis(delay));
            stage.destroy()?;
            stage.no_threads()
        })?;
    }
    stage.step("a second activity is created while the first is stopped", |stage| {
        let intent = stage.intent();
        stage.launch(intent);
        stage.shows(&expected)?;
        stage.with(|first| {
            first.focus(false);
            first.pause();
            first.destroy_window();
            first.stop();
        });
        let first = stage.activity.take();
        let intent = stage.intent();
        stage.launch(intent);
        stage.shows(&expected)?;
        if let Some(first) = first {
            destroy(first)?;
        }
        let presents = vulkan::presents();
        stage.with(|second| second.redraw());
        stage.shows_within_two(presents, &expected)?;
        stage.destroy()?;
        stage.no_threads()
    })?;
    stage.step("what was saved comes back", |stage| {
        let intent = stage.intent();
        stage.launch(intent);
        stage.shows(&expected)?;
        let mut saved = Vec::new();
        stage.with(|activity| saved = activity.save());
        stage.destroy()?;
        let intent = stage.intent();
        stage.create(intent, &saved);
        let size = stage.size;
        stage.with(|activity| {
            activity.start();
            activity.resume();
            activity.create_window(size);
            activity.focus(true);
        });
        stage.shows(&expected)?;
        stage.destroy()?;
        stage.no_threads()
    })?;
    stage.step("nothing is held: descriptors, windows, devices, local references", |_| {
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

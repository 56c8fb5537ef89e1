//! What goes wrong is said on the screen, and the back key still ends the app.

use std::time::{Duration, Instant};

use super::Outcome;
use super::harness::Harness;
use super::view::problem;
use crate::life::pump;
use crate::vulkan::{self, faults};
use crate::{log, report, window};

/// The loader's library is missing.
pub fn no_vulkan(harness: &mut Harness) -> Outcome {
    refusal(harness, |faults| faults.no_loader = true)
}

/// The loader finds no device.
pub fn no_device(harness: &mut Harness) -> Outcome {
    refusal(harness, |faults| faults.no_device = true)
}

/// The device's limits are too small.
pub fn small_limits(harness: &mut Harness) -> Outcome {
    refusal(harness, |faults| faults.small_limits = true)
}

fn refusal(harness: &mut Harness, fault: impl FnOnce(&mut faults::Faults)) -> Outcome {
    faults::with(fault);
    let mark = log::mark();
    harness.step("created, started, resumed, with a window", |harness| {
        let intent = harness.intent();
        harness.launch(intent);
        Ok(())
    })?;
    let line = harness.step("the log says what was expected and found", |harness| problem(harness, mark))?;
    report::say(&format!("      {line}"));
    harness.step("the message is on the screen, drawn without Vulkan", |harness| posted_after(harness, 0))?;
    harness.step("a new window, a turned one: the message is there again", |harness| {
        let (posts, size) = (window::posts(), harness.size);
        harness.with(|activity| {
            activity.pause();
            activity.destroy_window();
            activity.resume();
            activity.create_window(size);
        });
        posted_after(harness, posts)?;
        let posts = window::posts();
        harness.resize([size[1], size[0]]);
        posted_after(harness, posts)
    })?;
    harness.step("the back key closes the message, then the app; destroying it returns", back_twice)
}

/// A picture of the display's size and of more than one colour is drawn without Vulkan, and comes to rest.
fn posted_after(harness: &mut Harness, posts: u64) -> Outcome {
    let size = harness.size;
    let fits = || {
        let posted = window::posted().filter(|_| window::posts() > posts);
        posted.filter(|picture| [picture.width, picture.height] == size && !picture.is_of_one_colour())
    };
    let mut last = (None, Instant::now());
    let at_rest = pump(Duration::from_secs(30), || {
        let now = fits();
        if now != last.0 {
            last = (now, Instant::now());
        }
        last.0.is_some() && last.1.elapsed() > Duration::from_secs(2)
    });
    match fits().filter(|_| at_rest) {
        Some(picture) => harness.keep(&picture),
        None => Err(format!(
            "expected a picture of {size:?} pixels by ANativeWindow_lock, at rest; found {} of them, the last {:?}",
            window::posts() - posts,
            window::posted().map(|picture| ([picture.width, picture.height], picture.is_of_one_colour()))
        )),
    }
}

/// The first back key closes the message, the second the app.
fn back_twice(harness: &mut Harness) -> Outcome {
    super::hand::back(harness);
    harness.wait(Duration::from_secs(1));
    harness.back()
}

/// The device is lost once, and then three times in a row.
pub fn lost_device(harness: &mut Harness) -> Outcome {
    let expected = harness.opens()?;
    harness.step("what it counts is counted", |harness| {
        harness.rest()?;
        // Until what it counts is counted: what is lost while the overlay is painted makes egui-wgpu panic, which the app
        // catches and the log shows.
        harness.wait(Duration::from_secs(3));
        Ok(())
    })?;
    harness.step("lost once: the same picture comes back, on a new device", |harness| {
        let (first, devices) = (vulkan::presents(), vulkan::devices_created());
        faults::with(|faults| faults.lost_devices = 1);
        harness.with(|activity| activity.redraw());
        let is_back = || vulkan::presents() > first && vulkan::devices_created() > devices;
        if !pump(Duration::from_secs(90), is_back) {
            return Err("no picture from a new device".to_owned());
        }
        harness.shows(&expected)
    })?;
    let mark = log::mark();
    harness.step("lost three times in a row: a message", |harness| {
        faults::with(|faults| faults.lost_devices = 3);
        harness.with(|activity| activity.redraw());
        let line = problem(harness, mark)?;
        report::say(&format!("      {line}"));
        let all = faults::with(|faults| faults.lost_devices) == 0;
        if !all {
            return Err("the app gave up before the device was lost three times".to_owned());
        }
        // A device that is made after the third loss shows the message, and nothing else.
        let shown = harness.rest()?;
        match shown == expected || shown.is_of_one_colour() {
            true => Err("expected the message on the screen, found none".to_owned()),
            false => Ok(()),
        }
    })?;
    harness.step("the back key closes the message, then the app; destroying it returns", back_twice)
}

//! The display turns; surfaces become out of date, suboptimal, lost.

use super::Outcome;
use super::harness::Harness;
use crate::vulkan::{self, faults};

const TURNS: usize = 3;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let landscape = harness.size;
    let portrait = [landscape[1], landscape[0]];
    let expected = harness.opens()?;
    harness.step("the picture comes to rest", |harness| harness.rest().map(drop))?;
    for _ in 0..TURNS {
        harness.step("turned: a picture of the new size, one new swapchain", |harness| {
            let swapchains = vulkan::swapchains_created();
            harness.resize(portrait);
            let picture = harness.rest()?;
            if [picture.width, picture.height] != portrait {
                return Err(format!(
                    "expected {portrait:?} pixels, found {}x{}",
                    picture.width, picture.height
                ));
            }
            if picture.is_of_one_colour() {
                return Err("the picture is of one colour".to_owned());
            }
            no_more_than(swapchains, 1)
        })?;
        harness.step("turned back: the same picture, one new swapchain", |harness| {
            let swapchains = vulkan::swapchains_created();
            harness.resize(landscape);
            harness.shows(&expected)?;
            harness.rest()?;
            no_more_than(swapchains, 1)
        })?;
    }
    harness.step("suboptimal at every present: no new swapchain", |harness| {
        let swapchains = vulkan::swapchains_created();
        faults::with(|faults| faults.suboptimal = true);
        for _ in 0..20 {
            let first = vulkan::presents();
            harness.with(|activity| activity.redraw());
            harness.shows_within_two(first, &expected)?;
        }
        faults::with(|faults| faults.suboptimal = false);
        no_more_than(swapchains, 0)
    })?;
    harness.step("three swapchains out of date: three new ones, the same picture", |harness| {
        let swapchains = vulkan::swapchains_created();
        faults::with(|faults| faults.outdated = 3);
        survives(harness, |faults| faults.outdated, &expected)?;
        no_more_than(swapchains, 3)
    })?;
    harness.step("the surface is lost: one new swapchain, the same picture", |harness| {
        let swapchains = vulkan::swapchains_created();
        faults::with(|faults| faults.lost_surfaces = 1);
        survives(harness, |faults| faults.lost_surfaces, &expected)?;
        no_more_than(swapchains, 1)
    })
}

/// Asks for pictures until the faults have all happened and the expected one is shown after that.
fn survives(
    harness: &mut Harness,
    left: fn(&faults::Faults) -> u32,
    expected: &crate::picture::Picture,
) -> Outcome {
    for _ in 0..100 {
        harness.with(|activity| activity.redraw());
        harness.wait(std::time::Duration::from_millis(100));
        if faults::with(|faults| left(faults)) == 0 {
            let first = vulkan::presents();
            harness.with(|activity| activity.redraw());
            return harness.shows_within_two(first, expected);
        }
    }
    Err("the app does not present, although it was asked to draw again".to_owned())
}

fn no_more_than(before: u64, most: u64) -> Outcome {
    match vulkan::swapchains_created() - before {
        new if new <= most => Ok(()),
        new => Err(format!("expected {most} new swapchains at most, found {new}")),
    }
}

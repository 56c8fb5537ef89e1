//! Fingers move the camera.

use super::harness::Harness;
use super::{Outcome, hand};
use crate::life::{Activity, pump};
use std::time::Duration;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    harness.opens()?;
    harness.step("a drag changes the picture", |harness| {
        changes(harness, |harness| hand::drag(harness, [0.5, 0.5], [0.7, 0.6], 6))
    })?;
    harness.step("a pinch changes the picture", |harness| {
        changes(harness, |harness| hand::pinch(harness, 0.2, 0.6, 6))
    })?;
    harness.step("a batch of moves in one event changes the picture", |harness| {
        changes(harness, |harness| hand::drag_in_a_batch(harness, [0.6, 0.6], [0.4, 0.5]))
    })?;
    harness.step("a gesture taken away does nothing, and the next one works", |harness| {
        let before = harness.rest()?;
        hand::cancelled_drag(harness);
        let after = harness.rest()?;
        if let Some(difference) = after.difference(&before) {
            return Err(difference);
        }
        changes(harness, |harness| hand::drag(harness, [0.4, 0.5], [0.6, 0.4], 4))
    })?;
    harness.step("all events were handed back", |harness| {
        match pump(Duration::from_secs(2), || {
            harness.activity.as_ref().is_none_or(Activity::input_is_finished)
        }) {
            true => Ok(()),
            false => Err("AInputQueue_finishEvent was not called for all of them".to_owned()),
        }
    })
}

fn changes(harness: &mut Harness, gesture: impl FnOnce(&mut Harness)) -> Outcome {
    let before = harness.rest()?;
    gesture(harness);
    let after = harness.rest()?;
    match after == before {
        true => Err("the picture is the same".to_owned()),
        false => Ok(()),
    }
}

//! Fingers move the camera.

use super::harness::Stage;
use super::{Outcome, hand};
use crate::life::{Activity, pump};
use std::time::Duration;

/// Plays it.
pub fn play(stage: &mut Stage) -> Outcome {
    stage.opens()?;
    stage.step("a drag changes the picture", |stage| {
        changes(stage, |stage| hand::drag(stage, [0.5, 0.5], [0.7, 0.6], 6))
    })?;
    stage.step("a pinch changes the picture", |stage| {
        changes(stage, |stage| hand::pinch(stage, 0.2, 0.6, 6))
    })?;
    stage.step("a batch of moves in one event changes the picture", |stage| {
        changes(stage, |stage| hand::drag_in_a_batch(stage, [0.6, 0.6], [0.4, 0.5]))
    })?;
    stage.step("a gesture taken away does nothing, and the next one works", |stage| {
        let before = stage.rest()?;
        hand::cancelled_drag(stage);
        let after = stage.rest()?;
        if let Some(difference) = after.difference(&before) {
            return Err(difference);
        }
        changes(stage, |stage| hand::drag(stage, [0.4, 0.5], [0.6, 0.4], 4))
    })?;
    stage.step("all events were handed back", |stage| {
        match pump(Duration::from_secs(2), || stage.activity.as_ref().is_none_or(Activity::input_is_finished))
        {
            true => Ok(()),
            false => Err("AInputQueue_finishEvent was not called for all of them".to_owned()),
        }
    })
}

fn changes(stage: &mut Stage, gesture: impl FnOnce(&mut Stage)) -> Outcome {
    let before = stage.rest()?;
    gesture(stage);
    let after = stage.rest()?;
    match after == before {
        true => Err("the picture is the same".to_owned()),
        false => Ok(()),
    }
}

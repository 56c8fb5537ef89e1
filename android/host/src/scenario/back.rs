//! The back key ends the app.

use super::Outcome;
use super::harness::Stage;

/// Plays it.
pub fn play(stage: &mut Stage) -> Outcome {
    stage.opens()?;
    stage.step("the back key finishes the activity, and destroying it returns", Stage::back)?;
    stage.step("no thread of the app is left", |stage| stage.no_threads())
}

//! The back key ends the app.

use super::Outcome;
use super::harness::Harness;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    harness.opens()?;
    harness.step("the back key finishes the activity, and destroying it returns", Harness::back)?;
    harness.step("no thread of the app is left", |harness| harness.no_threads())
}

//! The device gets hot while the camera moves, and cools down.

use super::harness::Harness;
use super::{Outcome, hand};
use crate::life::pump;
use crate::{hint, log, thermal, vulkan};
use std::time::Duration;

/// Since this API level headroom can be read.
const HEADROOM: i32 = 31;
/// Since this API level there are performance hints.
const HINTS: i32 = 33;

/// Plays it.
pub fn play(harness: &mut Harness) -> Outcome {
    let (api, start) = (harness.options.api, log::mark());
    harness.step("the governor steers: a picture is presented", |harness| {
        let mut intent = harness.intent();
        intent.extras.insert("set".to_owned(), "overlay hidden".to_owned());
        harness.launch(intent);
        match pump(Duration::from_secs(60), || vulkan::presents() > 0) {
            true => harness.rest().map(drop),
            false => Err("nothing was presented".to_owned()),
        }
    })?;
    if api < HEADROOM {
        return harness.step(
            "an Android without headroom and hints: nothing of it, and the camera moves",
            |harness| {
                moving(harness, || false);
                let lines = log::since(start);
                match lines.iter().find(|line| line.contains("thermal: headroom")) {
                    Some(line) => Err(format!("expected no headroom, found `{line}`")),
                    None if thermal::managers() > 0 || hint::told().created > 0 => {
                        Err("expected no managers and sessions, found some".to_owned())
                    }
                    None => Ok(()),
                }
            },
        );
    }
    let mut shares = Vec::new();
    for headroom in [0.5, 0.95, 1.1, 0.5] {
        shares.push(harness.step(&format!("headroom {headroom} is read"), |harness| {
            let mark = log::mark();
            thermal::set_headroom(headroom);
            let found = || log::since(mark).iter().find_map(|line| share(line, headroom));
            moving(harness, || found().is_some());
            found().ok_or_else(|| format!("expected a line `thermal: headroom {headroom}, ...`, found none"))
        })?);
    }
    harness.step("the hotter, the less time a frame may take", |_| {
        match shares[0] >= shares[1] && shares[1] > shares[2] && shares[3] == shares[0] {
            true => Ok(()),
            false => Err(format!("expected shares that fall and come back, found {shares:?}")),
        }
    })?;
    if api >= HINTS {
        harness.step("a session of hints got the times of frames", |_| {
            let told = hint::told();
            match told.open == 1 && told.reports > 0 && !told.threads.is_empty() {
                true => Ok(()),
                false => Err(format!("expected one open session with reports, found {told:?}")),
            }
        })?;
    }
    harness.step("destroyed: managers and sessions are given back", |harness| {
        harness.destroy()?;
        match (thermal::managers(), hint::told().open) {
            (0, 0) => Ok(()),
            (managers, sessions) => Err(format!("found {managers} managers and {sessions} sessions")),
        }
    })
}

/// Drags to and fro until `done`, or for long enough that every reading was taken.
fn moving(harness: &mut Harness, done: impl Fn() -> bool) {
    for round in 0..40 {
        let (from, to) = if round % 2 == 0 { ([0.4, 0.5], [0.6, 0.5]) } else { ([0.6, 0.5], [0.4, 0.5]) };
        hand::drag(harness, from, to, 20);
        if done() {
            return;
        }
    }
}

/// The share of a line `thermal: headroom H, frames may take F of their time` with this headroom.
fn share(line: &str, headroom: f32) -> Option<f32> {
    let (_, rest) = line.split_once("thermal: headroom ")?;
    let (found, rest) = rest.split_once(',')?;
    let found: f32 = found.trim().parse().ok()?;
    let share = rest.split_once("may take ")?.1.split_whitespace().next()?;
    let (number, unit) = share.strip_suffix('%').map_or((share, 1.0), |number| (number, 0.01));
    let share: f32 = number.parse().ok()?;
    ((found - headroom).abs() < 0.006).then_some(share * unit)
}

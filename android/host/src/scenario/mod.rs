//! The scenarios: each is a function of readable steps on a [`Harness`].

mod again;
mod back;
mod errors;
mod hand;
mod harness;
mod life;
mod rotate;
mod start;
mod storm;
mod thermal;
mod touch;
mod view;

use std::time::{Duration, Instant};

use crate::bionic::API_LEVEL;
use crate::options::Options;
use crate::{assets, looper, report};
use harness::Harness;

/// What a step answers: what it found, or what was expected and found instead.
type Outcome<T = ()> = Result<T, String>;

type Scenario = fn(&mut Harness) -> Outcome;

const SCENARIOS: &[(&str, Scenario)] = &[
    ("start", start::play),
    ("life", life::play),
    ("rotate", rotate::play),
    ("touch", touch::play),
    ("back", back::play),
    ("again", again::play),
    ("view", view::play),
    ("thermal", thermal::play),
    ("storm", storm::play),
    ("errors:no-vulkan", errors::no_vulkan),
    ("errors:no-device", errors::no_device),
    ("errors:small-limits", errors::small_limits),
    ("errors:lost-device", errors::lost_device),
];

/// A whole run may take this long, a storm of `events` longer.
fn deadline(events: u64) -> Duration {
    Duration::from_secs(600 + events / 2)
}

/// Plays the scenario that the options name; answers the exit status.
pub fn play(options: Options) -> i32 {
    report::open();
    API_LEVEL.store(options.api, std::sync::atomic::Ordering::Relaxed);
    assets::open(options.assets.clone());
    looper::ALooper_prepare(0);
    let name = options.scenario.clone();
    let start = Instant::now();
    let _watch = report::watch(&name, deadline(options.events));
    let Some((_, scenario)) = SCENARIOS.iter().find(|(known, _)| *known == name) else {
        let known: Vec<_> = SCENARIOS.iter().map(|(known, _)| *known).collect();
        report::say(&format!("expected a scenario of {}, found `{name}`", known.join(", ")));
        return 2;
    };
    let outcome = Harness::new(options).and_then(|mut harness| {
        scenario(&mut harness)?;
        harness.finish()
    });
    let seconds = start.elapsed().as_secs_f64();
    match outcome {
        Ok(()) => {
            report::say(&format!("PASS  {name} ({seconds:.1} s)"));
            0
        }
        Err(problem) => {
            report::say(&format!("FAIL  {name}: {problem}"));
            1
        }
    }
}

//! The stress cases with few rays, and tests that they detect what they are made for.

use glimpse::{
    Robustness,
    stress::{Bench, CASES, Outcome},
};
use glimpse_tests::{gpu, note};

const RAYS: u64 = 20_000;

fn run(name: &str, rays: u64, robustness: Robustness) -> Outcome {
    let case = CASES.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
    let bench = Bench { gpu: gpu(), rays, seed: 1, robustness };
    (case.run)(&bench).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn every_case_passes() {
    let mut failed = Vec::new();
    for case in &CASES {
        let outcome = run(case.name, RAYS, Robustness::default());
        note(&format!("{}: {} rays, {} failures", case.name, outcome.rays, outcome.failures));
        assert!(outcome.rays >= RAYS * 9 / 10, "{}: only {} rays were judged", case.name, outcome.rays);
        failed.extend(outcome.worst.map(|worst| format!("{}: {worst}", case.name)));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Each measure against rounding has cases that fail without it.
#[test]
fn a_measure_left_out_is_noticed() {
    let all = Robustness::default();
    let without = [
        ("watertight", Robustness { watertight: false, ..all }, ["watertight", "vertices"].as_slice()),
        ("boxes", Robustness { boxes: false, ..all }, &["watertight"]),
        // Rays never hit the face that they leave; other faces in its plane are rarely near.
        ("offset", Robustness { offset: false, ..all }, &["self_hits"]),
    ];
    for (measure, robustness, cases) in without {
        for case in cases {
            let outcome = run(case, 10 * RAYS, robustness);
            note(&format!("{case} without {measure}: {} failures", outcome.failures));
            assert!(outcome.failures > 0, "{case} passes without {measure}");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_answers() {
    let outcomes = [(); 2].map(|()| run("slivers", RAYS, Robustness::default()));
    assert_eq!(outcomes[0], outcomes[1]);
}

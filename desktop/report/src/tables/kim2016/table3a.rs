//! Table 3(a): milliseconds of each kernel.

use super::{CITATION, pair_job};
use crate::job::Job;
use crate::record::Record;
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured};

/// Time of the adaptive method by the steps of the paper.
pub struct Kernels;

impl Table for Kernels {
    fn name(&self) -> &'static str {
        "3a"
    }

    fn summary(&self) -> &'static str {
        "Time by kernel"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        vec![pair_job(self.name(), request.base, [request.table3_side; 2], 1)]
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name())
            .map(|(scene, measured)| row(&scene.sized(measured.job.shown), &by_step(&measured.records[1])));
        Content::Rows(Rows {
            title: "Table 3(a): milliseconds by kernel",
            note: "One sample a pixel (the paper: 1024x1024). I, II-c and III-c trace rays; IV is postcorrection; ETC is all else of the \
                   frame."
                .to_owned(),
            head: ["scene"].into_iter().chain(STEPS.map(|(step, _)| step)).chain(["ETC", "frame"]).collect(),
            measured: rows.collect(),
            published: PUBLISHED.iter().map(|(scene, steps)| row(scene, steps)).collect(),
            citation: CITATION,
        })
    }
}

/// Steps of the paper, with the text that the names of their passes contain.
const STEPS: [(&str, &str); 8] = [
    ("I", "base"),
    ("II-a", "similarity_a1"),
    ("II-b", "compact_a1"),
    ("II-c", "trace_a1"),
    ("III-a", "similarity_a2"),
    ("III-b", "compact_a2"),
    ("III-c", "trace_a2"),
    ("IV", "postcorrect"),
];

/// Median milliseconds of each step, then of everything else in the frame.
fn by_step(record: &Record) -> [f64; 9] {
    let mut steps = [0.0; 9];
    for (pass, ms) in record.passes() {
        let step = STEPS.iter().position(|(_, name)| pass.contains(name));
        steps[step.unwrap_or(8)] += ms;
    }
    let timed: f64 = steps.iter().sum();
    steps[8] += (record.time().median - timed).max(0.0);
    steps
}

fn row(scene: &str, steps: &[f64; 9]) -> Vec<String> {
    let sum: f64 = steps.iter().sum();
    let cells = steps.iter().copied().chain([sum]).map(|ms| format!("{ms:.2}"));
    std::iter::once(scene.to_owned()).chain(cells).collect()
}

/// As printed for 1024x1024: milliseconds by step, then all else.
pub const PUBLISHED: [(&str, [f64; 9]); 6] = [
    ("Café", [284.3, 25.9, 10.4, 53.7, 38.5, 11.1, 94.6, 60.8, 11.8]),
    ("Ben", [329.8, 25.4, 11.5, 40.2, 36.8, 10.7, 66.7, 44.3, 9.8]),
    ("Kitchen", [341.7, 26.3, 10.2, 99.4, 37.5, 10.7, 207.1, 81.9, 13.2]),
    ("Conference", [206.4, 23.8, 10.0, 38.7, 37.3, 11.6, 81.8, 86.7, 11.6]),
    ("Bathroom", [300.7, 27.0, 10.0, 84.9, 37.1, 11.1, 185.2, 66.5, 11.0]),
    ("San Miguel", [362.7, 24.0, 10.7, 126.0, 34.3, 11.0, 198.1, 130.0, 8.7]),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::tests::example;

    /// The time of a renamed pass would count among all else.
    #[test]
    fn every_step_names_a_stage() {
        for (step, name) in STEPS {
            assert!(glimpse::Tracing::of_pass(name).is_some(), "step {step}: no stage is named {name}");
        }
    }

    #[test]
    fn passes_belong_to_the_papers_steps() {
        let mut record = example("r", 20.0, None);
        record.frames[0].passes = [
            ("base", 8.0),
            ("similarity_a1", 1.0),
            ("compact_a1", 0.5),
            ("trace_a1", 2.0),
            ("similarity_a2", 1.5),
            ("compact_a2", 0.25),
            ("trace_a2", 3.0),
            ("postcorrect_seed", 0.5),
            ("compact_postcorrect", 0.25),
            ("postcorrect", 1.0),
            ("resolve", 0.75),
        ]
        .map(|(name, ms)| (name.to_owned(), ms))
        .to_vec();
        // The rest of the frame's 20 ms is in no pass.
        assert_eq!(by_step(&record), [8.0, 1.0, 0.5, 2.0, 1.5, 0.25, 3.0, 1.75, 2.0]);
    }
}

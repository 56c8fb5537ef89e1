//! Table 3(c): times by RT ratio.

use super::{CITATION, Pair, pair_job, varied};
use crate::job::Job;
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table};

/// Rotations of the camera about the vertical, in degrees.
const TURNS: [f32; 5] = [0.0, 72.0, 144.0, 216.0, 288.0];

/// Views with different RT ratios, from rotating the camera in place.
pub struct Views;

impl Table for Views {
    fn name(&self) -> &'static str {
        "3c"
    }

    fn summary(&self) -> &'static str {
        "RT ratio varied"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let job = |turn| Job { turn, ..pair_job(self.name(), request.base, [request.table3_side; 2], 1) };
        TURNS.map(job).to_vec()
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let mut rows = Vec::new();
        for scene in scenes {
            let views = scene.of_table(self.name()).map(|measured| (&measured.job, Pair::of(measured)));
            let mut views: Vec<_> = views.collect();
            views.sort_by(|a, b| a.1.rt_ratio.total_cmp(&b.1.rt_ratio));
            rows.extend(views.into_iter().map(|(job, pair)| {
                let name = format!("{}, turned by {}°", scene.sized(job.shown), job.turn);
                varied(&name, pair.rt_ratio, pair.full_ms, pair.adaptive_ms)
            }));
        }
        let published = PUBLISHED.iter().map(|&(ratio, full, ours)| varied("Conference", ratio, full, ours));
        Content::Rows(Rows {
            title: "Table 3(c): RT ratio varied",
            note: "One sample a pixel (the paper: 1024x1024), five views: the camera turned about the vertical where it stands. Sorted \
                   by RT ratio."
                .to_owned(),
            head: vec!["scene", "RT ratio", "full ms", "adaptive ms", "speedup"],
            measured: rows,
            published: published.collect(),
            citation: CITATION,
        })
    }
}

/// As printed for the Conference: RT ratio, milliseconds of full ray tracing and of the paper's method.
const PUBLISHED: [(f64, f64, f64); 5] = [
    (0.259, 944.6, 362.1),
    (0.266, 884.7, 414.4),
    (0.280, 866.4, 460.4),
    (0.291, 859.8, 521.7),
    (0.321, 904.7, 606.1),
];

//! Table 3(b): times by share of reflective pixels.

use super::{CITATION, Pair, pair_job, varied};
use crate::job::Job;
use crate::scene::SceneReport;
use crate::subject::{SHARES, Variant};
use crate::table::{Content, Request, Rows, Table, measured};

/// The scene with growing sets of reflective objects.
pub struct Reflective;

impl Table for Reflective {
    fn name(&self) -> &'static str {
        "3b"
    }

    fn summary(&self) -> &'static str {
        "Share of reflective pixels varied"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        let job = |share| Job {
            variant: Variant::Reflective(share),
            ..pair_job(self.name(), request.base, [request.table3_side; 2], 1)
        };
        SHARES.map(job).to_vec()
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name()).map(|(scene, measured)| {
            let (share, pair) = (measured.records[0].reflective_share, Pair::of(measured));
            varied(&scene.sized(measured.job.shown), share, pair.full_ms, pair.adaptive_ms)
        });
        let published = PUBLISHED.iter().map(|&(share, full, ours)| varied("Bathroom", share, full, ours));
        Content::Rows(Rows {
            title: "Table 3(b): share of reflective pixels varied",
            note: "One sample a pixel (the paper: 1024x1024). The paper moves the camera; here the view stays and surfaces change: all \
                   are opaque with a diffuse share of 0.7, and a growing set of objects (the largest that fit under 20, 40, \
                   60 and 80 % of the pixels, then all) mirrors a share of 0.3. The share is that of the pixels whose first \
                   hit is such a mirror."
                .to_owned(),
            head: vec!["scene", "reflective pixels", "full ms", "adaptive ms", "speedup"],
            measured: rows.collect(),
            published: published.collect(),
            citation: CITATION,
        })
    }
}

/// As printed for the Bathroom: share of reflective pixels, milliseconds of full ray tracing and of the
/// paper's method.
const PUBLISHED: [(f64, f64, f64); 5] = [
    (0.199, 813.3, 454.0),
    (0.411, 870.2, 451.8),
    (0.609, 992.8, 495.1),
    (0.820, 1054.4, 493.5),
    (0.999, 1077.3, 437.0),
];

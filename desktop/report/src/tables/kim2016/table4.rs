//! Table 4: sampling rates of the hairball.

use super::{CITATION, Pair, SAMPLINGS, pair, pair_job};
use crate::job::Job;
use crate::scene::SceneReport;
use crate::table::{Content, Request, Rows, Table, measured};

/// Several sampling rates of a scene whose name contains "hairball".
pub struct Hairball;

impl Table for Hairball {
    fn name(&self) -> &'static str {
        "4"
    }

    fn summary(&self) -> &'static str {
        "Sampling of scenes named hairball"
    }

    fn jobs(&self, request: &Request<'_>) -> Vec<Job> {
        if !request.scene.name.to_lowercase().contains("hairball") {
            return Vec::new();
        }
        SAMPLINGS.map(|sampling| pair_job(self.name(), request.base, request.size, sampling)).to_vec()
    }

    fn content(&self, scenes: &[SceneReport]) -> Content {
        let rows = measured(scenes, self.name())
            .map(|(scene, measured)| Pair::of(measured).row([scene.sized(measured.job.shown)]));
        Content::Rows(Rows {
            title: "Table 4: the hairball",
            note: "As table 5. The paper's is Laine and Karras's of 2,880,000 triangles, reflective, with three lights, on a \
                   desktop GPU."
                .to_owned(),
            head: ["scene"].into_iter().chain(Pair::HEAD).collect(),
            measured: rows.collect(),
            published: PUBLISHED.iter().map(|pair| pair.row(["Hairball, 3840x2160".to_owned()])).collect(),
            citation: CITATION,
        })
    }
}

/// As printed for 3840x2160.
const PUBLISHED: [Pair; 5] = [
    pair(1, 5200.0, 2600.0, 0.390, 31.72),
    pair(2, 18900.0, 9400.0, 0.378, 37.73),
    pair(4, 66600.0, 32600.0, 0.360, 42.21),
    pair(8, 232_100.0, 110_300.0, 0.343, 45.62),
    pair(16, 803_800.0, 369_600.0, 0.329, 48.16),
];

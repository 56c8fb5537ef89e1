//! Samples of one eye that count for the other (Kim & Sung 2021).

use super::{FrameSpec, sources::pick, stage::*, wgsl};
use crate::{
    Crossing,
    gpu::shader::Source,
    plan::{Plan, Rows, tiles},
};

stages! {
    /// Projects what paths have met into the other eye and tests that it is seen from there.
    LOOK = {
        name: "look", wgsl: "passes/look.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.look_sources(entry),
    }
    /// Adds the samples of the other eye to the pixels that they fall into.
    CROSS = {
        name: "cross", wgsl: "passes/cross.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let one = spec.one_sample();
            let mut sources = one.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
            sources.extend(spec.output_before_noise().sources());
            sources.extend([wgsl!("wgsl/samples_crossing.wgsl"), entry]);
            sources
        },
    }
}

/// Both directions, after the paths of both eyes.
pub fn plan(plan: &mut Plan, width: u32, rows: Rows) {
    plan.push(tiles(&LOOK, width, rows));
    plan.push(tiles(&CROSS, width, rows));
}

impl FrameSpec {
    pub(super) fn eyes(&self) -> Source {
        pick(self.two_eyes(), wgsl!("wgsl/eyes_two.wgsl"), wgsl!("wgsl/eyes_one.wgsl"))
    }

    /// Where samples of one eye count for the other.
    fn crossing(&self) -> Crossing {
        if self.two_eyes() { self.settings.paths.crossing } else { Crossing::Off }
    }

    /// What becomes of the samples of paths.
    pub(super) fn path_samples(&self) -> Vec<Source> {
        let [met, added] = match self.crossing() {
            Crossing::Off => [wgsl!("wgsl/crossing_none.wgsl"), wgsl!("wgsl/samples_alone.wgsl")],
            Crossing::Paper | Crossing::Weighted => {
                [wgsl!("wgsl/crossing_met.wgsl"), wgsl!("wgsl/samples_leave.wgsl")]
            }
        };
        let mut sources = vec![met];
        sources.extend(self.path_sums());
        sources.push(added);
        sources
    }

    /// Where they are added up.
    pub(super) fn path_sums(&self) -> Vec<Source> {
        match self.crossing() {
            Crossing::Off => vec![wgsl!("wgsl/samples.wgsl"), wgsl!("wgsl/samples_mean.wgsl")],
            Crossing::Paper | Crossing::Weighted => vec![wgsl!("wgsl/samples_crossing.wgsl")],
        }
    }

    fn look_sources(&self, entry: Source) -> Vec<Source> {
        let one = self.one_sample();
        let mut sources = one.scene_sources(wgsl!("wgsl/attributes_planes.wgsl"), self.hit());
        sources.extend(self.numbers());
        sources.extend([
            wgsl!("wgsl/channels.wgsl"),
            self.lobes(),
            wgsl!("wgsl/eyes_two.wgsl"),
            wgsl!("wgsl/look.wgsl"),
        ]);
        if self.settings.paths.crossing == Crossing::Paper {
            sources.push(wgsl!("wgsl/crossing_paper.wgsl"));
        } else {
            sources.extend([
                self.stopping(),
                wgsl!("wgsl/crossing.wgsl"),
                pick(
                    self.features.reflection,
                    wgsl!("wgsl/crossing_mirror.wgsl"),
                    wgsl!("wgsl/crossing_straight.wgsl"),
                ),
            ]);
        }
        sources.extend([wgsl!("wgsl/samples_crossing.wgsl"), self.order(), entry]);
        sources
    }
}

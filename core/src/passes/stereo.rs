//! Samples of one eye that count for the other (Kim & Sung 2021).

use super::{FrameSpec, sources::pick, stage::*, wgsl};
use crate::{
    Crossing,
    device::shader::Source,
    frame::plan::{Plan, Rows, tiles},
};

stages! {
    /// Projects what paths have met into the other eye and tests that it is seen from there.
    LOOK = {
        name: "look", wgsl: "passes/stereo/stereo_reproject.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.look_sources(entry),
    }
    /// Adds the samples of the other eye to the pixels that they fall into.
    CROSS = {
        name: "cross", wgsl: "passes/stereo/stereo_gather.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let one = spec.one_sample();
            let mut sources = one.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
            sources.extend(spec.output_before_noise().sources());
            sources.extend([wgsl!("wgsl/stereo/samples_stereo.wgsl"), entry]);
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
        pick(self.two_eyes(), wgsl!("wgsl/stereo/eyes_stereo.wgsl"), wgsl!("wgsl/stereo/eyes_mono.wgsl"))
    }

    /// Where samples of one eye count for the other.
    fn crossing(&self) -> Crossing {
        if self.two_eyes() { self.settings.paths.crossing } else { Crossing::Off }
    }

    /// What becomes of the samples of paths.
    pub(super) fn path_samples(&self) -> Vec<Source> {
        let [met, added] = match self.crossing() {
            Crossing::Off => [wgsl!("wgsl/stereo/stereo_reuse_none.wgsl"), wgsl!("wgsl/path/samples_add.wgsl")],
            Crossing::Paper | Crossing::Weighted => {
                [wgsl!("wgsl/stereo/stereo_reuse_vertices.wgsl"), wgsl!("wgsl/stereo/samples_defer.wgsl")]
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
            Crossing::Off => vec![wgsl!("wgsl/output/samples.wgsl"), wgsl!("wgsl/path/samples_mean.wgsl")],
            Crossing::Paper | Crossing::Weighted => vec![wgsl!("wgsl/stereo/samples_stereo.wgsl")],
        }
    }

    fn look_sources(&self, entry: Source) -> Vec<Source> {
        let one = self.one_sample();
        let mut sources = one.scene_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"), self.hit());
        sources.extend(self.numbers());
        sources.extend([
            wgsl!("wgsl/path/max_component.wgsl"),
            self.lobes(),
            wgsl!("wgsl/stereo/eyes_stereo.wgsl"),
            wgsl!("wgsl/stereo/stereo_reprojection.wgsl"),
        ]);
        if self.settings.paths.crossing == Crossing::Paper {
            sources.push(wgsl!("wgsl/stereo/stereo_reuse_paper.wgsl"));
        } else {
            sources.extend([
                self.stopping(),
                wgsl!("wgsl/stereo/stereo_reuse_weighted.wgsl"),
                pick(
                    self.features.reflection,
                    wgsl!("wgsl/stereo/stereo_reuse_mirror.wgsl"),
                    wgsl!("wgsl/stereo/stereo_reuse_direct.wgsl"),
                ),
            ]);
        }
        sources.extend([wgsl!("wgsl/stereo/samples_stereo.wgsl"), self.order(), entry]);
        sources
    }
}

//! Stereo reuse: samples of one eye contribute to pixels of the other (Kim & Sung 2021).

use super::{FrameSpec, sources::pick, stage::*, wgsl};
use crate::{
    StereoReuse,
    device::shader::Source,
    frame::plan::{Plan, Rows, tiles},
};

stages! {
    /// Reprojects the hit points of paths into the other eye and tests whether it sees them.
    STEREO_REPROJECT = {
        name: "stereo_reproject", wgsl: "passes/stereo/stereo_reproject.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(TRACED_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.stereo_reproject_sources(entry),
    }
    /// Adds the samples reprojected from the other eye to the pixels that they fall into.
    STEREO_GATHER = {
        name: "stereo_gather", wgsl: "passes/stereo/stereo_gather.wgsl", paper: "Kim & Sung 2021, equations 1 to 6, Algorithm 1",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let one = spec.one_sample();
            let mut sources = one.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
            sources.extend(spec.output_sources(spec.output_before_noise()));
            sources.extend([wgsl!("wgsl/stereo/samples_stereo.wgsl"), entry]);
            sources
        },
    }
}

/// Adds both passes; they run after the paths of both eyes.
pub fn plan(plan: &mut Plan, width: u32, rows: Rows) {
    plan.push(tiles(&STEREO_REPROJECT, width, rows));
    plan.push(tiles(&STEREO_GATHER, width, rows));
}

impl FrameSpec {
    pub(super) fn eyes(&self) -> Source {
        pick(self.two_eyes(), wgsl!("wgsl/stereo/eyes_stereo.wgsl"), wgsl!("wgsl/stereo/eyes_mono.wgsl"))
    }

    /// How samples of one eye are reused for the other; off without a second eye.
    fn stereo_reuse(&self) -> StereoReuse {
        if self.two_eyes() { self.settings.paths.stereo_reuse } else { StereoReuse::Off }
    }

    /// The sources that store a path's samples.
    pub(super) fn path_samples(&self) -> Vec<Source> {
        let [met, added] = match self.stereo_reuse() {
            StereoReuse::Off => [wgsl!("wgsl/stereo/stereo_reuse_none.wgsl"), wgsl!("wgsl/path/samples_add.wgsl")],
            StereoReuse::Paper | StereoReuse::Weighted => {
                [wgsl!("wgsl/stereo/stereo_reuse_vertices.wgsl"), wgsl!("wgsl/stereo/samples_defer.wgsl")]
            }
        };
        let mut sources = vec![met];
        sources.extend(self.path_sums());
        sources.push(added);
        sources
    }

    /// The sources of the sums of the samples.
    pub(super) fn path_sums(&self) -> Vec<Source> {
        match self.stereo_reuse() {
            StereoReuse::Off => vec![wgsl!("wgsl/output/samples.wgsl"), wgsl!("wgsl/path/samples_mean.wgsl")],
            StereoReuse::Paper | StereoReuse::Weighted => vec![wgsl!("wgsl/stereo/samples_stereo.wgsl")],
        }
    }

    fn stereo_reproject_sources(&self, entry: Source) -> Vec<Source> {
        let one = self.one_sample();
        let mut sources = one.scene_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"), self.hit());
        sources.extend(self.rng());
        sources.extend(self.lobes());
        sources.extend([
            wgsl!("wgsl/stereo/eyes_stereo.wgsl"),
            wgsl!("wgsl/stereo/stereo_reprojection.wgsl"),
        ]);
        if self.settings.paths.stereo_reuse == StereoReuse::Paper {
            sources.push(wgsl!("wgsl/stereo/stereo_reuse_paper.wgsl"));
        } else {
            sources.extend([
                self.foveation(),
                wgsl!("wgsl/stereo/stereo_reuse_weighted.wgsl"),
                pick(
                    self.features.reflection,
                    wgsl!("wgsl/stereo/stereo_reuse_mirror.wgsl"),
                    wgsl!("wgsl/stereo/stereo_reuse_direct.wgsl"),
                ),
            ]);
        }
        sources.extend([wgsl!("wgsl/stereo/samples_stereo.wgsl"), self.tile_order(), entry]);
        sources
    }
}

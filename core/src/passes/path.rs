//! Path tracing (Kajiya 1986): a path through every pixel of each frame, added to those of the frames before.

use super::{Output, Recipe, recipe::Storage, FrameSpec, denoise, sources::pick, stage::*, stereo, wgsl};
use crate::{
    Denoise, Direct, Sampler, Shining, Stopping,
    gpu::shader::Source,
    plan::{Band, Plan, tiles},
};

stages! {
    /// Traces a path through every pixel.
    PATH = {
        name: "path", wgsl: "passes/path.wgsl", paper: "Kajiya 1986; Kim & Sung 2021, equation 7",
        work: Work::Tiles(PATH_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.path_sources(entry),
    }
    /// Adds samples that were traced elsewhere to the sums of the pixels; it runs between frames.
    MERGE_PLANES = {
        name: "merge_planes", wgsl: "passes/merge_planes.wgsl", paper: "Kim & Sung 2021, Algorithm 5",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = vec![spec.constants(), wgsl!("wgsl/frame.wgsl"), spec.jitter()];
            sources.extend(spec.path_sums());
            sources.extend(spec.output_before_noise().sources());
            sources.push(entry);
            sources
        },
    }
}

/// Path tracing of one picture or of one for each eye.
pub const RECIPE: Recipe = Recipe { plan, traced: &PATH, storage: Storage { radiances: 1, ..Storage::WHOLE }, interpolated: &[] };

/// A path through every pixel, and what is done about their noise.
fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let (width, rows) = (plan.grid[0], band.rows(1, band.own));
    plan.push(tiles(&PATH, width, rows));
    if spec.settings.crosses() {
        stereo::plan(plan, width, rows);
    }
    denoise::plan(plan, spec.settings.denoise(), width, rows);
}

impl FrameSpec {
    fn path_sources(&self, entry: Source) -> Vec<Source> {
        let f = &self.features;
        let guides = self.settings.paths.denoise != Denoise::Off;
        let one = Self { output: self.output_before_noise(), ..self.one_sample() };
        let mut sources = one.scene_sources(wgsl!("wgsl/attributes_planes.wgsl"), self.hit());
        sources.extend(self.numbers());
        sources.extend([
            wgsl!("wgsl/channels.wgsl"),
            self.lobes(),
            pick(
                f.lights && self.settings.paths.shining != Shining::Emitters,
                wgsl!("wgsl/punctual.wgsl"),
                wgsl!("wgsl/punctual_none.wgsl"),
            ),
            match (self.settings.paths.direct, self.settings.paths.shining) {
                (_, Shining::Punctual) => wgsl!("wgsl/emitters_dark.wgsl"),
                (Direct::Light | Direct::Mis, _) if self.scene.emits => wgsl!("wgsl/emitters.wgsl"),
                _ => wgsl!("wgsl/emitters_met.wgsl"),
            },
            self.stopping(),
            self.eyes(),
            wgsl!("wgsl/guides.wgsl"),
            pick(guides && !self.inspect, wgsl!("wgsl/guides_kept.wgsl"), wgsl!("wgsl/guides_none.wgsl")),
            wgsl!("wgsl/path.wgsl"),
        ]);
        sources.extend(self.path_samples());
        sources.extend([self.order(), entry]);
        sources
    }

    /// Where colours go whose noise is yet to be removed: what does that shows them.
    pub(super) fn output_before_noise(&self) -> Output {
        if self.settings.paths.denoise == Denoise::Off { self.output } else { Output::Nowhere }
    }

    pub(super) fn stopping(&self) -> Source {
        pick(
            self.settings.paths.stopping == Stopping::Off,
            wgsl!("wgsl/stopping_none.wgsl"),
            wgsl!("wgsl/stopping.wgsl"),
        )
    }

    pub(super) fn numbers(&self) -> [Source; 2] {
        let source = match self.settings.paths.sampler {
            Sampler::Random => wgsl!("wgsl/numbers_random.wgsl"),
            Sampler::Sobol => wgsl!("wgsl/numbers_sobol.wgsl"),
        };
        [wgsl!("wgsl/numbers.wgsl"), source]
    }

    pub(super) fn lobes(&self) -> Source {
        pick(self.features.glossy, wgsl!("wgsl/lobes.wgsl"), wgsl!("wgsl/lobes_matte.wgsl"))
    }
}

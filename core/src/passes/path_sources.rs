//! What the kernels of paths are made of.

use super::{Output, Stage, Variant, sources::pick, wgsl};
use crate::{Crossing, Denoise, Direct, Sampler, Shining, Stopping, gpu::shader::Source};

impl Variant {
    /// What a kernel needs that follows paths.
    pub(super) fn path_sources(&self) -> Vec<Source> {
        let f = &self.features;
        let guides = self.paths.denoise != Denoise::Off;
        let one = Self { sampling: 1, output: self.output_before_noise(), ..*self };
        let mut sources = one.scene_sources(wgsl!("wgsl/attributes_planes.wgsl"), self.hit());
        sources.extend(self.numbers());
        sources.extend([
            wgsl!("wgsl/channels.wgsl"),
            self.lobes(),
            pick(
                f.lights && self.paths.shining != Shining::Emitters,
                wgsl!("wgsl/punctual.wgsl"),
                wgsl!("wgsl/punctual_none.wgsl"),
            ),
            match (self.paths.direct, self.paths.shining) {
                (_, Shining::Punctual) => wgsl!("wgsl/emitters_dark.wgsl"),
                (Direct::Light | Direct::Mis, _) if self.emits => wgsl!("wgsl/emitters.wgsl"),
                _ => wgsl!("wgsl/emitters_met.wgsl"),
            },
            self.stopping(),
            self.eyes(),
            wgsl!("wgsl/guides.wgsl"),
            pick(guides && !self.inspect, wgsl!("wgsl/guides_kept.wgsl"), wgsl!("wgsl/guides_none.wgsl")),
            wgsl!("wgsl/path.wgsl"),
        ]);
        sources.extend(self.path_samples());
        sources.extend([self.order(), Stage::Path.entry()]);
        sources
    }

    /// Where colours go whose noise is yet to be removed: what does that shows them.
    fn output_before_noise(&self) -> Output {
        if self.paths.denoise == Denoise::Off { self.output } else { Output::Nowhere }
    }

    fn stopping(&self) -> Source {
        pick(
            self.paths.stopping == Stopping::Off,
            wgsl!("wgsl/stopping_none.wgsl"),
            wgsl!("wgsl/stopping.wgsl"),
        )
    }

    fn eyes(&self) -> Source {
        pick(self.two_eyes, wgsl!("wgsl/eyes_two.wgsl"), wgsl!("wgsl/eyes_one.wgsl"))
    }

    /// Where samples of one eye count for the other.
    fn crossing(&self) -> Crossing {
        if self.two_eyes { self.paths.crossing } else { Crossing::Off }
    }

    /// What becomes of the samples of paths.
    fn path_samples(&self) -> Vec<Source> {
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
    fn path_sums(&self) -> Vec<Source> {
        match self.crossing() {
            Crossing::Off => vec![wgsl!("wgsl/samples.wgsl"), wgsl!("wgsl/samples_mean.wgsl")],
            Crossing::Paper | Crossing::Weighted => vec![wgsl!("wgsl/samples_crossing.wgsl")],
        }
    }

    pub(super) fn look_sources(&self) -> Vec<Source> {
        let one = Self { sampling: 1, ..*self };
        let mut sources = one.scene_sources(wgsl!("wgsl/attributes_planes.wgsl"), self.hit());
        sources.extend(self.numbers());
        sources.extend([
            wgsl!("wgsl/channels.wgsl"),
            self.lobes(),
            wgsl!("wgsl/eyes_two.wgsl"),
            wgsl!("wgsl/look.wgsl"),
        ]);
        if self.paths.crossing == Crossing::Paper {
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
        sources.extend([wgsl!("wgsl/samples_crossing.wgsl"), self.order(), Stage::Look.entry()]);
        sources
    }

    fn numbers(&self) -> [Source; 2] {
        let source = match self.paths.sampler {
            Sampler::Random => wgsl!("wgsl/numbers_random.wgsl"),
            Sampler::Sobol => wgsl!("wgsl/numbers_sobol.wgsl"),
        };
        [wgsl!("wgsl/numbers.wgsl"), source]
    }

    fn lobes(&self) -> Source {
        pick(self.features.glossy, wgsl!("wgsl/lobes.wgsl"), wgsl!("wgsl/lobes_matte.wgsl"))
    }

    pub(super) fn cross_sources(&self) -> Vec<Source> {
        let one = Self { sampling: 1, ..*self };
        let mut sources = one.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
        sources.extend(self.output_before_noise().sources());
        sources.extend([wgsl!("wgsl/samples_crossing.wgsl"), Stage::Cross.entry()]);
        sources
    }

    pub(super) fn merge_sources(&self) -> Vec<Source> {
        let mut sources = vec![self.constants(), wgsl!("wgsl/frame.wgsl"), self.jitter()];
        sources.extend(self.path_sums());
        sources.extend(self.output_before_noise().sources());
        sources.push(Stage::MergePlanes.entry());
        sources
    }

    /// What a kernel needs that treats noise of paths, and ends in these.
    pub(super) fn noise_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let mut sources = vec![
            self.constants(),
            wgsl!("wgsl/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/octahedral.wgsl"),
            wgsl!("wgsl/guides.wgsl"),
            self.eyes(),
            wgsl!("wgsl/noise.wgsl"),
            self.order(),
        ];
        sources.extend(self.path_sums());
        sources.extend(self.output.sources());
        sources.extend(entry);
        sources
    }
}

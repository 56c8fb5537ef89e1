//! Path tracing (Kajiya 1986): each frame adds one path per pixel to the samples of the frames before.

use super::{Output, Recipe, recipe::Storage, FrameSpec, denoise, sources::pick, stage::*, stereo, wgsl};
use crate::{
    Denoise, DirectLight, Sampler, LightSelection, Foveation,
    device::shader::Source,
    frame::plan::{Band, Plan, tiles},
};

stages! {
    /// Traces one path through every pixel and adds its radiance to the pixel's sum.
    PATH = {
        name: "path", wgsl: "passes/path/path.wgsl", paper: "Kajiya 1986; Kim & Sung 2021, equation 7",
        work: Work::Tiles(PATH_TILE), tracing: Tracing::Neighbours, clears: [],
        sources: |spec, entry| spec.path_sources(entry),
    }
    /// Adds samples that were traced by the CPU to the sums of the pixels; runs between frames.
    ACCUMULATE = {
        name: "accumulate", wgsl: "passes/path/accumulate.wgsl", paper: "Kim & Sung 2021, Algorithm 5",
        work: Work::Tiles(INTERPOLATED_TILE), tracing: Tracing::No, clears: [],
        sources: |spec, entry| {
            let mut sources = vec![spec.constants(), wgsl!("wgsl/trace/frame.wgsl"), spec.jitter()];
            sources.extend(spec.path_sums());
            sources.extend(spec.output_sources(spec.output_before_noise()));
            sources.push(entry);
            sources
        },
    }
}

/// Path tracing of one image, or of one for each eye.
pub const RECIPE: Recipe = Recipe { plan, traced: &PATH, storage: Storage { radiances: 1, ..Storage::WHOLE }, interpolated: &[] };

/// A path through every pixel, stereo reuse and the denoiser.
fn plan(plan: &mut Plan, spec: &FrameSpec, band: &Band) {
    let (width, rows) = (plan.grid[0], band.rows(1, band.own));
    plan.push(tiles(&PATH, width, rows));
    if spec.settings.reuses_stereo() {
        stereo::plan(plan, width, rows);
    }
    denoise::plan(plan, spec.settings.denoise(), width, rows);
}

impl FrameSpec {
    fn path_sources(&self, entry: Source) -> Vec<Source> {
        let f = &self.features;
        let gbuffer = self.settings.paths.denoise != Denoise::Off;
        let one = Self { output: self.output_before_noise(), ..self.one_sample() };
        let mut sources = one.scene_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"), self.hit());
        sources.extend(self.rng());
        sources.extend(self.lobes());
        sources.extend([
            pick(
                f.microfacets,
                wgsl!("wgsl/path/response_microfacet.wgsl"),
                wgsl!("wgsl/path/response_diffuse.wgsl"),
            ),
            pick(
                f.lights && self.settings.paths.lights != LightSelection::Emitters,
                wgsl!("wgsl/path/punctual_nee.wgsl"),
                wgsl!("wgsl/path/punctual_none.wgsl"),
            ),
            match (self.settings.paths.direct_light, self.settings.paths.lights) {
                (_, LightSelection::Punctual) => wgsl!("wgsl/path/emitters_unlit.wgsl"),
                (DirectLight::Nee | DirectLight::Mis, _) if self.scene.emits => wgsl!("wgsl/path/emitters_nee.wgsl"),
                _ => wgsl!("wgsl/path/emitters_bsdf.wgsl"),
            },
            pick(
                self.samples_environment(),
                wgsl!("wgsl/path/environment_nee.wgsl"),
                wgsl!("wgsl/path/environment_bsdf.wgsl"),
            ),
            pick(f.coverage, wgsl!("wgsl/path/layers_coverage.wgsl"), wgsl!("wgsl/path/layers_none.wgsl")),
            self.foveation(),
            self.eyes(),
            wgsl!("wgsl/denoise/gbuffer.wgsl"),
            pick(gbuffer && !self.inspect, wgsl!("wgsl/denoise/gbuffer_record.wgsl"), wgsl!("wgsl/denoise/gbuffer_none.wgsl")),
            pick(f.dispersion, wgsl!("wgsl/path/dispersion.wgsl"), wgsl!("wgsl/path/dispersion_none.wgsl")),
            wgsl!("wgsl/path/path.wgsl"),
        ]);
        sources.extend(self.path_samples());
        sources.extend([self.tile_order(), entry]);
        sources
    }

    /// Whether paths draw directions of an environment map.
    fn samples_environment(&self) -> bool {
        let paths = &self.settings.paths;
        self.features.environment_map
            && paths.direct_light != DirectLight::Bsdf
            && paths.lights != LightSelection::Punctual
    }

    /// Where kernels write colours before the denoiser: nowhere if a denoiser follows, as it writes the pixels.
    pub(super) fn output_before_noise(&self) -> Output {
        if self.settings.paths.denoise == Denoise::Off { self.output } else { Output::Nowhere }
    }

    pub(super) fn foveation(&self) -> Source {
        pick(
            self.settings.paths.foveation == Foveation::Off,
            wgsl!("wgsl/path/foveation_none.wgsl"),
            wgsl!("wgsl/path/foveation.wgsl"),
        )
    }

    pub(super) fn rng(&self) -> [Source; 2] {
        let source = match self.settings.paths.sampler {
            Sampler::Random => wgsl!("wgsl/path/rng_independent.wgsl"),
            Sampler::Sobol => wgsl!("wgsl/path/rng_sobol.wgsl"),
        };
        [wgsl!("wgsl/path/rng.wgsl"), source]
    }

    /// The lobes of surfaces.
    pub(super) fn lobes(&self) -> Vec<Source> {
        let f = &self.features;
        let mut sources = vec![
            wgsl!("wgsl/path/max_component.wgsl"),
            wgsl!("wgsl/path/directions.wgsl"),
            wgsl!("wgsl/path/bsdf_sample.wgsl"),
        ];
        if !f.microfacets && !f.glossy {
            sources.push(wgsl!("wgsl/path/lobes_matte.wgsl"));
            return sources;
        }
        sources.extend([
            pick(f.coat_normals, wgsl!("wgsl/path/coat_apart.wgsl"), wgsl!("wgsl/path/coat_shared.wgsl")),
            wgsl!("wgsl/path/lobes_specular.wgsl"),
        ]);
        if !f.microfacets {
            sources.push(wgsl!("wgsl/path/lobes.wgsl"));
            return sources;
        }
        if !f.sheen {
            sources.push(wgsl!("wgsl/shade/lobe_albedos.wgsl"));
        }
        sources.extend([
            pick(
                f.anisotropy,
                wgsl!("wgsl/path/lobes_anisotropic.wgsl"),
                wgsl!("wgsl/path/lobes_isotropic.wgsl"),
            ),
            pick(f.translucency, wgsl!("wgsl/path/behind.wgsl"), wgsl!("wgsl/path/behind_none.wgsl")),
            wgsl!("wgsl/path/microfacets.wgsl"),
            wgsl!("wgsl/path/lobes_microfacet.wgsl"),
        ]);
        sources
    }
}

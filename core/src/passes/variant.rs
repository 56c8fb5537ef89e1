//! What a kernel is made of: the only place that chooses WGSL files.

use super::{Stage, wgsl};
use crate::{Features, GpuScene, Linking, Robustness, Scene, bvh::MAX_STACK, gpu::shader::Source};

/// Where colours go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// sRGB, 8 bits.
    Display,
    /// Linear radiance, 32-bit floating point.
    Linear,
}

/// What decides which pieces a kernel is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// What is linked.
    pub features: Features,
    /// With [`Linking::All`] what the scene has is not known either: numbers of lights and of words a vertex are read.
    pub linking: Linking,
    /// The scene stores texture coordinates.
    pub has_texcoords: bool,
    /// The scene stores vertex colours.
    pub has_colors: bool,
    /// Light passes straight through some surfaces of the scene, whatever is linked.
    pub has_panes: bool,
    /// Counting kernels.
    pub inspect: bool,
    /// Where colours go.
    pub output: Output,
    /// Groups on the traversal stack.
    pub bvh_stack: u32,
    /// Levels of rays.
    pub depth: u32,
    /// Lights of the scene.
    pub lights: u32,
    /// Objects of the scene.
    pub objects: u32,
    /// The measures against rounding.
    pub robustness: Robustness,
}

impl Variant {
    /// Timed frames of a scene.
    #[must_use]
    pub fn new(scene: &GpuScene, linking: Linking, depth: u32) -> Self {
        Self {
            features: scene.features(),
            linking: Linking::Auto,
            has_texcoords: scene.has_texcoords,
            has_colors: scene.has_colors,
            has_panes: scene.features().panes,
            inspect: false,
            output: Output::Display,
            bvh_stack: scene.bvh_stack,
            depth,
            lights: scene.light_count,
            objects: scene.object_count,
            robustness: Robustness::default(),
        }
        .linked(linking)
    }

    /// Timed frames of a scene that is not on a device; its tree is not built and may be any.
    pub(super) fn of_scene(scene: &Scene, linking: Linking) -> Self {
        let features = Features::of(scene);
        Self {
            features,
            linking: Linking::Auto,
            has_texcoords: !scene.texcoords.is_empty(),
            has_colors: !scene.colors.is_empty(),
            has_panes: features.panes,
            inspect: false,
            output: Output::Display,
            bvh_stack: MAX_STACK,
            depth: 1,
            lights: scene.lights.len() as u32,
            objects: scene.objects.len() as u32,
            robustness: Robustness::default(),
        }
        .linked(linking)
    }

    fn linked(self, linking: Linking) -> Self {
        match linking {
            Linking::Auto => self,
            Linking::All => Self { features: Features::all(), linking, bvh_stack: MAX_STACK, ..self },
        }
    }

    /// Where the shadow bits begin in the word of the object; `None` if they need a word of their own.
    pub(super) fn shadow_shift(&self) -> Option<u32> {
        let object_bits = 32 - self.objects.leading_zeros();
        (self.linking == Linking::Auto && object_bits + self.lights < 32).then_some(object_bits)
    }

    /// The planes of the attribute buffer, in order.
    #[must_use]
    pub fn planes(&self) -> Vec<&'static str> {
        let f = &self.features;
        let optional = [
            ("SHADOW", self.shadow_shift().is_none()),
            ("FACE", f.smooth_normals),
            ("GCOL", f.reflection || f.refraction),
            ("TEXCOORD", f.textures),
            ("COLOR", f.vertex_colors),
        ];
        let present = optional.into_iter().filter_map(|(name, there)| there.then_some(name));
        ["DEPTH", "OBJECT", "NORMAL"].into_iter().chain(present).collect()
    }

    /// The sources of a stage's kernel, in order.
    #[must_use]
    pub fn sources(&self, stage: Stage) -> Vec<Source> {
        match stage {
            Stage::CompactA1 | Stage::CompactA2 => {
                vec![self.constants(), wgsl!("wgsl/list.wgsl"), stage.entry()]
            }
            Stage::SimilarityA1 | Stage::SimilarityA2 => self.shading_sources([
                wgsl!("wgsl/similarity.wgsl"),
                wgsl!("passes/similarity_step.wgsl"),
                stage.entry(),
            ]),
            Stage::Full | Stage::Base => self.tracing_sources([stage.entry()]),
            Stage::TraceA1 | Stage::TraceA2 => self.tracing_sources([wgsl!("wgsl/list.wgsl"), stage.entry()]),
        }
    }

    /// The sources of a kernel that traces rays and ends in these.
    pub(crate) fn tracing_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let hit = match (self.features.alpha_mask, self.features.shadow_filter) {
            (true, _) => wgsl!("wgsl/hit_alpha.wgsl"),
            (false, true) => wgsl!("wgsl/hit_shadow.wgsl"),
            (false, false) => wgsl!("wgsl/hit_all.wgsl"),
        };
        self.tracing_sources_with(hit, entry)
    }

    /// As [`Variant::tracing_sources`], with another say in which hits count.
    pub(crate) fn tracing_sources_with(
        &self,
        hit: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        let f = &self.features;
        let pick = |present: bool, with: Source, without: Source| if present { with } else { without };
        let mut sources = self.shading_sources([
            pick(self.robustness.watertight, wgsl!("wgsl/edge_exact.wgsl"), wgsl!("wgsl/edge_rounded.wgsl")),
            wgsl!("wgsl/triangle.wgsl"),
            wgsl!("wgsl/bvh.wgsl"),
            pick(f.spheres, wgsl!("wgsl/sphere_analytic.wgsl"), wgsl!("wgsl/sphere_none.wgsl")),
            pick(
                self.linking == Linking::All || self.has_texcoords || self.has_colors,
                wgsl!("wgsl/vertex_attributes.wgsl"),
                wgsl!("wgsl/vertex_none.wgsl"),
            ),
            hit,
            wgsl!("wgsl/surface.wgsl"),
            pick(f.lights, wgsl!("wgsl/shadow_rays.wgsl"), wgsl!("wgsl/shadow_none.wgsl")),
            match (f.reflection, f.refraction) {
                (_, true) => wgsl!("wgsl/bounce_glass.wgsl"),
                (true, false) => wgsl!("wgsl/bounce_mirror.wgsl"),
                (false, false) => wgsl!("wgsl/bounce_none.wgsl"),
            },
            wgsl!("wgsl/sample.wgsl"),
        ]);
        sources.extend(entry);
        sources
    }

    fn shading_sources<const N: usize>(&self, rest: [Source; N]) -> Vec<Source> {
        let f = &self.features;
        let mut sources = vec![
            self.constants(),
            wgsl!("wgsl/frame.wgsl"),
            wgsl!("wgsl/octahedral.wgsl"),
            wgsl!("wgsl/attributes.wgsl"),
            if self.inspect { wgsl!("wgsl/inspect_counters.wgsl") } else { wgsl!("wgsl/inspect_none.wgsl") },
            match self.output {
                Output::Display => wgsl!("wgsl/output_display.wgsl"),
                Output::Linear => wgsl!("wgsl/output_linear.wgsl"),
            },
            wgsl!("wgsl/object.wgsl"),
            if f.textures { wgsl!("wgsl/texture_atlas.wgsl") } else { wgsl!("wgsl/texture_none.wgsl") },
            wgsl!("wgsl/fresnel.wgsl"),
            if f.glossy { wgsl!("wgsl/material.wgsl") } else { wgsl!("wgsl/material_matte.wgsl") },
            if f.lights { wgsl!("wgsl/lights_punctual.wgsl") } else { wgsl!("wgsl/lights_none.wgsl") },
        ];
        sources.extend(rest);
        sources
    }
}

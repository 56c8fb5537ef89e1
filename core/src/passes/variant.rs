//! What a kernel is made of: the only place that chooses WGSL files.

use super::{Stage, wgsl};
use crate::{Features, GpuScene, Linking, Robustness, gpu::shader::Source};

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
    /// The scene stores texture coordinates.
    pub has_texcoords: bool,
    /// The scene stores vertex colours.
    pub has_colors: bool,
    /// Light passes straight through some surfaces.
    pub has_panes: bool,
    /// The device is a CPU, whose cores share a dispatch by ranges.
    pub on_cpu: bool,
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
            features: match linking {
                Linking::Auto => scene.features(),
                Linking::All => Features::all(),
            },
            has_texcoords: scene.has_texcoords,
            has_colors: scene.has_colors,
            has_panes: scene.has_panes,
            on_cpu: scene.on_cpu,
            inspect: false,
            output: Output::Display,
            bvh_stack: scene.bvh_stack,
            depth,
            lights: scene.light_count,
            objects: scene.object_count,
            robustness: Robustness::default(),
        }
    }

    /// Where the shadow bits begin in the word of the object; `None` if they need a word of their own.
    pub(super) fn shadow_shift(&self) -> Option<u32> {
        let object_bits = 32 - self.objects.leading_zeros();
        (object_bits + self.lights < 32).then_some(object_bits)
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
                self.order(),
                stage.entry(),
            ]),
            Stage::Full | Stage::Base => self.tracing_sources([self.order(), stage.entry()]),
            Stage::TraceA1 | Stage::TraceA2 => self.tracing_sources([wgsl!("wgsl/list.wgsl"), stage.entry()]),
        }
    }

    /// Which workgroup treats which tile.
    fn order(&self) -> Source {
        if self.on_cpu { wgsl!("wgsl/order_dealt.wgsl") } else { wgsl!("wgsl/order_plain.wgsl") }
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
                self.has_texcoords || self.has_colors,
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
            wgsl!("wgsl/material.wgsl"),
            if f.lights { wgsl!("wgsl/lights_punctual.wgsl") } else { wgsl!("wgsl/lights_none.wgsl") },
        ];
        sources.extend(rest);
        sources
    }
}

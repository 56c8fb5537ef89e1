//! The WGSL files that kernels of several methods have in common.

use super::{FrameSpec, Output, wgsl};
use crate::{Filter, Inactive, Jitter, Linking, Mip, gpu::shader::Source};

impl Output {
    pub(super) fn sources(self) -> Vec<Source> {
        match self {
            Self::Display => vec![wgsl!("wgsl/output_display.wgsl")],
            Self::Linear => vec![wgsl!("wgsl/output_linear.wgsl")],
            Self::Samples => vec![wgsl!("wgsl/samples.wgsl"), wgsl!("wgsl/output_samples.wgsl")],
            Self::Nowhere => vec![wgsl!("wgsl/output_nowhere.wgsl")],
        }
    }
}

impl FrameSpec {
    /// What a kernel needs that compacts a list; `range` says which part of it.
    pub(super) fn compact_sources(&self, range: Source, entry: Source) -> Vec<Source> {
        vec![self.constants(), wgsl!("wgsl/list.wgsl"), range, entry]
    }

    /// What a kernel needs that interpolates between references or lists.
    pub(super) fn similarity_sources(&self, entry: Source) -> Vec<Source> {
        self.shading_sources(
            wgsl!("wgsl/attributes_planes.wgsl"),
            [
                wgsl!("wgsl/list.wgsl"),
                wgsl!("wgsl/list_append.wgsl"),
                wgsl!("wgsl/similarity.wgsl"),
                wgsl!("passes/similarity_step.wgsl"),
                self.order(),
                entry,
            ],
        )
    }

    /// What a kernel needs that makes pixels from stored samples.
    pub(super) fn resolve_sources(&self, entry: Source) -> Vec<Source> {
        let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
        sources.extend([wgsl!("wgsl/samples.wgsl"), wgsl!("wgsl/order_net.wgsl")]);
        sources.push(match self.settings.filter {
            Filter::Box => wgsl!("wgsl/filter_box.wgsl"),
            Filter::Tent => wgsl!("wgsl/filter_tent.wgsl"),
        });
        sources.extend(self.output.sources());
        sources.push(entry);
        sources
    }

    /// Which workgroup treats which tile.
    pub(super) fn order(&self) -> Source {
        if self.tier.deals_workgroups() {
            wgsl!("wgsl/order_dealt.wgsl")
        } else {
            wgsl!("wgsl/order_plain.wgsl")
        }
    }

    pub(super) fn jitter(&self) -> Source {
        if self.settings.jitter == Jitter::On {
            wgsl!("wgsl/jitter_stratified.wgsl")
        } else {
            wgsl!("wgsl/jitter_none.wgsl")
        }
    }

    pub(super) fn inactive(&self) -> Source {
        match self.settings.inactive {
            Inactive::Nearest => wgsl!("wgsl/inactive_nearest.wgsl"),
            Inactive::Bilinear => wgsl!("wgsl/inactive_bilinear.wgsl"),
        }
    }

    /// The sources of a kernel that traces rays and ends in these.
    pub(crate) fn tracing_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        self.tracing_sources_with(self.hit(), entry)
    }

    pub(super) fn hit(&self) -> Source {
        match (self.features.alpha_mask, self.features.shadow_filter) {
            (true, _) => wgsl!("wgsl/hit_alpha.wgsl"),
            (false, true) => wgsl!("wgsl/hit_shadow.wgsl"),
            (false, false) => wgsl!("wgsl/hit_all.wgsl"),
        }
    }

    /// As [`FrameSpec::tracing_sources`], with another say in which hits count.
    pub(crate) fn tracing_sources_with(
        &self,
        hit: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        self.tracing_sources_from(wgsl!("wgsl/attributes_planes.wgsl"), hit, entry)
    }

    pub(super) fn tracing_sources_from(
        &self,
        attributes: Source,
        hit: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        let f = &self.features;
        let mut sources = self.scene_sources(attributes, hit);
        sources.extend([
            pick(self.secondary, wgsl!("wgsl/secondary_kept.wgsl"), wgsl!("wgsl/secondary_none.wgsl")),
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

    /// What a kernel needs that meets surfaces and their lights.
    pub(super) fn scene_sources(&self, attributes: Source, hit: Source) -> Vec<Source> {
        let f = &self.features;
        self.shading_sources(
            attributes,
            [
                pick(
                    self.robustness.watertight,
                    wgsl!("wgsl/edge_exact.wgsl"),
                    wgsl!("wgsl/edge_rounded.wgsl"),
                ),
                wgsl!("wgsl/triangle.wgsl"),
                pick(
                    self.tier.stores_images(),
                    wgsl!("wgsl/tree_texels.wgsl"),
                    wgsl!("wgsl/tree_buffers.wgsl"),
                ),
                wgsl!("wgsl/bvh.wgsl"),
                pick(f.spheres, wgsl!("wgsl/sphere_analytic.wgsl"), wgsl!("wgsl/sphere_none.wgsl")),
                hit,
                pick(self.averages_textures(), wgsl!("wgsl/cone.wgsl"), wgsl!("wgsl/cone_none.wgsl")),
                wgsl!("wgsl/surface.wgsl"),
                pick(f.lights, wgsl!("wgsl/shadow_rays.wgsl"), wgsl!("wgsl/shadow_none.wgsl")),
            ]
            .into_iter()
            .chain(self.vertex_sources()),
        )
    }

    fn vertex_sources(&self) -> Vec<Source> {
        if self.settings.features != Linking::All && !self.scene.has_texcoords && !self.scene.has_colors {
            return vec![wgsl!("wgsl/vertex_none.wgsl")];
        }
        vec![
            pick(
                self.tier.stores_images(),
                wgsl!("wgsl/vertex_texels.wgsl"),
                wgsl!("wgsl/vertex_buffers.wgsl"),
            ),
            wgsl!("wgsl/vertex_attributes.wgsl"),
        ]
    }

    /// What a kernel needs that knows pixels and their attributes.
    pub(super) fn pixel_sources(&self, attributes: Source) -> Vec<Source> {
        vec![
            self.constants(),
            wgsl!("wgsl/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/octahedral.wgsl"),
            wgsl!("wgsl/attributes.wgsl"),
            attributes,
            if self.inspect { wgsl!("wgsl/inspect_counters.wgsl") } else { wgsl!("wgsl/inspect_none.wgsl") },
        ]
    }

    fn shading_sources(&self, attributes: Source, rest: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let f = &self.features;
        let mut sources = self.pixel_sources(attributes);
        sources.extend([
            wgsl!("wgsl/object.wgsl"),
            pick(
                self.tier.stores_images(),
                wgsl!("wgsl/object_texels.wgsl"),
                wgsl!("wgsl/object_buffers.wgsl"),
            ),
        ]);
        if self.tier.stores_images() {
            sources.push(wgsl!("wgsl/texels.wgsl"));
        }
        sources.extend(match (f.textures, self.settings.mip) {
            (false, _) => vec![wgsl!("wgsl/texture_none.wgsl")],
            (true, Mip::Off) => vec![wgsl!("wgsl/texture_atlas.wgsl"), wgsl!("wgsl/texture_plain.wgsl")],
            (true, Mip::On) => vec![wgsl!("wgsl/texture_atlas.wgsl"), wgsl!("wgsl/texture_mip.wgsl")],
        });
        sources.extend([
            wgsl!("wgsl/fresnel.wgsl"),
            if f.glossy { wgsl!("wgsl/material.wgsl") } else { wgsl!("wgsl/material_matte.wgsl") },
            if f.lights { wgsl!("wgsl/lights_punctual.wgsl") } else { wgsl!("wgsl/lights_none.wgsl") },
        ]);
        if self.settings.supersamples() {
            sources.extend([wgsl!("wgsl/edges.wgsl"), wgsl!("wgsl/edges_keep.wgsl")]);
        } else {
            sources.push(wgsl!("wgsl/edges_none.wgsl"));
        }
        let pixels = self.settings.sampling == 1 || self.output == Output::Nowhere;
        sources.extend(if pixels { self.output } else { Output::Samples }.sources());
        sources.extend(rest);
        sources
    }
}

pub(super) fn pick(present: bool, with: Source, without: Source) -> Source {
    if present { with } else { without }
}

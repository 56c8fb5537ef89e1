//! What a kernel is made of: the only place that chooses WGSL files, with `path_sources.rs` for those of paths.

use super::{Output, Stage, Variant, wgsl};
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

impl Variant {
    /// The sources of a stage's kernel, in order.
    #[must_use]
    pub fn sources(&self, stage: Stage) -> Vec<Source> {
        match stage {
            Stage::CompactA1
            | Stage::CompactA2
            | Stage::CompactRenew
            | Stage::CompactQuincunxA
            | Stage::CompactQuincunxB => self.compact_sources(stage, wgsl!("wgsl/list_step.wgsl")),
            Stage::CompactSeed | Stage::CompactCellTest => {
                self.compact_sources(stage, wgsl!("wgsl/list_all.wgsl"))
            }
            Stage::CompactPostcorrect => self.compact_sources(stage, wgsl!("wgsl/list_round.wgsl")),
            Stage::CompactActive => self.compact_sources(stage, wgsl!("wgsl/list_active.wgsl")),
            Stage::CompactRefine | Stage::CompactCells => {
                self.compact_sources(stage, wgsl!("wgsl/list_refine.wgsl"))
            }
            Stage::SimilarityA1 | Stage::SimilarityA2 => self.shading_sources(
                wgsl!("wgsl/attributes_planes.wgsl"),
                [
                    wgsl!("wgsl/list.wgsl"),
                    wgsl!("wgsl/list_append.wgsl"),
                    wgsl!("wgsl/similarity.wgsl"),
                    wgsl!("passes/similarity_step.wgsl"),
                    self.order(),
                    stage.entry(),
                ],
            ),
            Stage::QuincunxBase => self.quincunx_tracing_sources([self.order(), stage.entry()]),
            Stage::QuincunxTraceA | Stage::QuincunxTraceB => self.quincunx_tracing_sources([
                wgsl!("wgsl/list.wgsl"),
                wgsl!("wgsl/quincunx_list.wgsl"),
                stage.entry(),
            ]),
            Stage::QuincunxSplitA | Stage::QuincunxSplitB => self.quincunx_pixel_sources(
                wgsl!("wgsl/quincunx_split.wgsl"),
                [
                    wgsl!("wgsl/list.wgsl"),
                    wgsl!("wgsl/list_append.wgsl"),
                    wgsl!("wgsl/quincunx_list.wgsl"),
                    stage.entry(),
                ],
            ),
            Stage::QuincunxResolve => {
                let mut entry = self.output.sources();
                entry.push(stage.entry());
                self.quincunx_pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"), entry)
            }
            Stage::SubpixelTest => self.test_sources(
                stage,
                [wgsl!("wgsl/list.wgsl"), wgsl!("wgsl/list_append.wgsl"), wgsl!("wgsl/active.wgsl")],
            ),
            Stage::RefineTest => self.test_sources(stage, [wgsl!("wgsl/refine_list.wgsl")]),
            Stage::ExtraSamples => self.extra_sources(),
            Stage::Refine | Stage::Cells => self.refine_sources(stage),
            Stage::CellTest => {
                let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_claims.wgsl"));
                sources.extend(refined_sources());
                sources.extend([wgsl!("wgsl/edges.wgsl"), stage.entry()]);
                sources
            }
            Stage::Full | Stage::Base | Stage::Presample => {
                self.tracing_sources([self.order(), stage.entry()])
            }
            Stage::Checkerboard => {
                let samples = Self { output: Output::Samples, ..*self };
                samples.tracing_sources([self.order(), stage.entry()])
            }
            Stage::Resolve | Stage::Fill => {
                let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
                sources.extend([wgsl!("wgsl/samples.wgsl"), wgsl!("wgsl/order_net.wgsl")]);
                sources.push(match self.filter {
                    Filter::Box => wgsl!("wgsl/filter_box.wgsl"),
                    Filter::Tent => wgsl!("wgsl/filter_tent.wgsl"),
                });
                sources.extend(self.output.sources());
                sources.push(stage.entry());
                sources
            }
            Stage::TraceA1 | Stage::TraceA2 => self.tracing_sources([wgsl!("wgsl/list.wgsl"), stage.entry()]),
            Stage::PostcorrectSeed | Stage::PostcorrectLandmarks => {
                let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_claims.wgsl"));
                sources.extend(postcorrect_sources(stage));
                sources
            }
            Stage::Postcorrect => self.tracing_sources_from(
                wgsl!("wgsl/attributes_claims.wgsl"),
                self.hit(),
                postcorrect_sources(stage),
            ),
            Stage::PostcorrectScan => {
                self.tracing_sources_from(wgsl!("wgsl/attributes_claims.wgsl"), self.hit(), [stage.entry()])
            }
            Stage::Frameless => {
                self.tracing_sources([wgsl!("wgsl/renewal.wgsl"), self.order(), stage.entry()])
            }
            Stage::ReprojectDepth | Stage::ReprojectSource => vec![
                self.constants(),
                wgsl!("wgsl/frame.wgsl"),
                self.jitter(),
                wgsl!("wgsl/history_before.wgsl"),
                wgsl!("wgsl/reproject.wgsl"),
                stage.entry(),
            ],
            Stage::Reuse => {
                let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
                sources.extend(self.output.sources());
                sources.extend([
                    wgsl!("wgsl/list.wgsl"),
                    wgsl!("wgsl/list_append.wgsl"),
                    wgsl!("wgsl/renewal.wgsl"),
                    wgsl!("wgsl/history_before.wgsl"),
                    wgsl!("wgsl/history.wgsl"),
                    stage.entry(),
                ]);
                sources
            }
            Stage::Path => self.path_sources(),
            Stage::Look => self.look_sources(),
            Stage::Cross => self.cross_sources(),
            Stage::Median => self.noise_sources([stage.entry()]),
            Stage::AtrousBegin => self.noise_sources([wgsl!("wgsl/filtered.wgsl"), stage.entry()]),
            Stage::Atrous | Stage::AtrousEnd => self.noise_sources([
                wgsl!("wgsl/filtered.wgsl"),
                wgsl!("wgsl/atrous.wgsl"),
                pick(stage == Stage::Atrous, wgsl!("wgsl/atrous_kept.wgsl"), wgsl!("wgsl/atrous_shown.wgsl")),
                stage.entry(),
            ]),
            Stage::MergePlanes => self.merge_sources(),
            Stage::Renew => {
                self.tracing_sources([wgsl!("wgsl/list.wgsl"), wgsl!("wgsl/history.wgsl"), stage.entry()])
            }
        }
    }

    fn compact_sources(&self, stage: Stage, range: Source) -> Vec<Source> {
        vec![self.constants(), wgsl!("wgsl/list.wgsl"), range, stage.entry()]
    }

    /// Which workgroup treats which tile.
    pub(super) fn order(&self) -> Source {
        if self.on_cpu { wgsl!("wgsl/order_dealt.wgsl") } else { wgsl!("wgsl/order_plain.wgsl") }
    }

    /// What finds out where extra samples go.
    fn test_sources(&self, stage: Stage, list: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let mut sources = self.pixel_sources(wgsl!("wgsl/attributes_planes.wgsl"));
        sources.extend(list);
        sources.extend([
            wgsl!("wgsl/edges.wgsl"),
            wgsl!("wgsl/contrast.wgsl"),
            wgsl!("wgsl/edges_range.wgsl"),
            wgsl!("wgsl/quarters.wgsl"),
            self.inactive(),
            self.order(),
            stage.entry(),
        ]);
        sources.extend(self.output.sources());
        sources
    }

    /// As a kernel of extra samples sees it, which lie anywhere in their cells unless that is off.
    fn extra(&self) -> Self {
        let jitter = if self.jitter == Jitter::Off { Jitter::Off } else { Jitter::On };
        Self { jitter, secondary: false, ..*self }
    }

    fn refine_sources(&self, stage: Stage) -> Vec<Source> {
        let of_tracing = [wgsl!("wgsl/edges_range.wgsl"), wgsl!("wgsl/refine_trace.wgsl"), stage.entry()];
        let entry = refined_sources().into_iter().chain(of_tracing);
        self.extra().tracing_sources_from(wgsl!("wgsl/attributes_claims.wgsl"), self.hit(), entry)
    }

    fn extra_sources(&self) -> Vec<Source> {
        self.extra().tracing_sources([
            wgsl!("wgsl/list.wgsl"),
            wgsl!("wgsl/active.wgsl"),
            wgsl!("wgsl/order_net.wgsl"),
            self.inactive(),
            Stage::ExtraSamples.entry(),
        ])
    }

    fn quincunx_tracing_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let nowhere = Self { output: Output::Nowhere, ..*self };
        let shared =
            [wgsl!("wgsl/contrast.wgsl"), wgsl!("wgsl/quincunx.wgsl"), wgsl!("wgsl/quincunx_ray.wgsl")];
        nowhere.tracing_sources(shared.into_iter().chain(entry))
    }

    fn quincunx_pixel_sources(
        &self,
        attributes: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        let mut sources = self.pixel_sources(attributes);
        sources.extend([wgsl!("wgsl/contrast.wgsl"), wgsl!("wgsl/quincunx.wgsl")]);
        sources.extend(entry);
        sources
    }

    pub(super) fn jitter(&self) -> Source {
        if self.jitter == Jitter::On {
            wgsl!("wgsl/jitter_stratified.wgsl")
        } else {
            wgsl!("wgsl/jitter_none.wgsl")
        }
    }

    fn inactive(&self) -> Source {
        match self.inactive {
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

    /// As [`Variant::tracing_sources`], with another say in which hits count.
    pub(crate) fn tracing_sources_with(
        &self,
        hit: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        self.tracing_sources_from(wgsl!("wgsl/attributes_planes.wgsl"), hit, entry)
    }

    fn tracing_sources_from(
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
                pick(self.on_cpu, wgsl!("wgsl/tree_texels.wgsl"), wgsl!("wgsl/tree_buffers.wgsl")),
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
        if self.linking != Linking::All && !self.has_texcoords && !self.has_colors {
            return vec![wgsl!("wgsl/vertex_none.wgsl")];
        }
        vec![
            pick(self.on_cpu, wgsl!("wgsl/vertex_texels.wgsl"), wgsl!("wgsl/vertex_buffers.wgsl")),
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
            pick(self.on_cpu, wgsl!("wgsl/object_texels.wgsl"), wgsl!("wgsl/object_buffers.wgsl")),
        ]);
        if self.on_cpu {
            sources.push(wgsl!("wgsl/texels.wgsl"));
        }
        sources.extend(match (f.textures, self.mip) {
            (false, _) => vec![wgsl!("wgsl/texture_none.wgsl")],
            (true, Mip::Off) => vec![wgsl!("wgsl/texture_atlas.wgsl"), wgsl!("wgsl/texture_plain.wgsl")],
            (true, Mip::On) => vec![wgsl!("wgsl/texture_atlas.wgsl"), wgsl!("wgsl/texture_mip.wgsl")],
        });
        sources.extend([
            wgsl!("wgsl/fresnel.wgsl"),
            if f.glossy { wgsl!("wgsl/material.wgsl") } else { wgsl!("wgsl/material_matte.wgsl") },
            if f.lights { wgsl!("wgsl/lights_punctual.wgsl") } else { wgsl!("wgsl/lights_none.wgsl") },
        ]);
        if self.supersamples {
            sources.extend([wgsl!("wgsl/edges.wgsl"), wgsl!("wgsl/edges_keep.wgsl")]);
        } else {
            sources.push(wgsl!("wgsl/edges_none.wgsl"));
        }
        let pixels = self.sampling == 1 || self.output == Output::Nowhere;
        sources.extend(if pixels { self.output } else { Output::Samples }.sources());
        sources.extend(rest);
        sources
    }
}

pub(super) fn pick(present: bool, with: Source, without: Source) -> Source {
    if present { with } else { without }
}

/// What is known of pixels that are refined.
fn refined_sources() -> [Source; 4] {
    [
        wgsl!("wgsl/refine_list.wgsl"),
        wgsl!("wgsl/order_net.wgsl"),
        wgsl!("wgsl/contrast.wgsl"),
        wgsl!("wgsl/refine.wgsl"),
    ]
}

fn postcorrect_sources(stage: Stage) -> [Source; 4] {
    [
        wgsl!("wgsl/list.wgsl"),
        wgsl!("wgsl/list_append.wgsl"),
        wgsl!("passes/postcorrect_step.wgsl"),
        stage.entry(),
    ]
}

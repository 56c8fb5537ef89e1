//! The WGSL files that kernels of several methods share.

use super::{FrameSpec, Output, wgsl};
use crate::{Filter, Jitter, Mip, Specialize, Tonemap, Unsampled, device::shader::Source};

impl FrameSpec {
    /// The sources that write colours to an output.
    pub(super) fn output_sources(&self, output: Output) -> Vec<Source> {
        match output {
            Output::Display => vec![
                pick(
                    self.settings.tonemap == Tonemap::Neutral,
                    wgsl!("wgsl/output/tone_neutral.wgsl"),
                    wgsl!("wgsl/output/tone_none.wgsl"),
                ),
                wgsl!("wgsl/output/output_display.wgsl"),
            ],
            Output::Linear => vec![wgsl!("wgsl/output/output_linear.wgsl")],
            Output::Samples => {
                vec![wgsl!("wgsl/output/samples.wgsl"), wgsl!("wgsl/output/output_samples.wgsl")]
            }
            Output::Nowhere => vec![wgsl!("wgsl/output/output_none.wgsl")],
        }
    }

    /// The sources of a kernel that compacts a list; `range` selects the part of the list.
    pub(super) fn compact_sources(&self, range: Source, entry: Source) -> Vec<Source> {
        vec![self.constants(), wgsl!("wgsl/adaptive/list.wgsl"), range, entry]
    }

    /// The sources of a kernel that checks similarity and interpolates or lists samples.
    pub(super) fn similarity_sources(&self, entry: Source) -> Vec<Source> {
        self.shading_sources(
            wgsl!("wgsl/adaptive/attributes_channels.wgsl"),
            [
                wgsl!("wgsl/adaptive/list.wgsl"),
                wgsl!("wgsl/adaptive/list_append.wgsl"),
                wgsl!("wgsl/adaptive/similarity.wgsl"),
                pick(
                    self.mirrors_environment(),
                    wgsl!("wgsl/adaptive/similarity_mirror.wgsl"),
                    wgsl!("wgsl/adaptive/similarity_mirror_none.wgsl"),
                ),
                pick(
                    self.features.extended_materials,
                    wgsl!("wgsl/adaptive/similarity_maps.wgsl"),
                    wgsl!("wgsl/adaptive/similarity_maps_none.wgsl"),
                ),
                pick(
                    self.features.coverage,
                    wgsl!("wgsl/adaptive/similarity_coverage.wgsl"),
                    wgsl!("wgsl/adaptive/similarity_coverage_none.wgsl"),
                ),
                wgsl!("passes/similarity_step.wgsl"),
                self.tile_order(),
                entry,
            ],
        )
    }

    /// The sources of a kernel that filters stored samples to pixels.
    pub(super) fn resolve_sources(&self, entry: Source) -> Vec<Source> {
        let mut sources = self.pixel_sources(wgsl!("wgsl/adaptive/attributes_channels.wgsl"));
        sources.extend([wgsl!("wgsl/output/samples.wgsl"), wgsl!("wgsl/supersample/sample_order.wgsl")]);
        sources.push(match self.settings.filter {
            Filter::Box => wgsl!("wgsl/output/filter_box.wgsl"),
            Filter::Tent => wgsl!("wgsl/output/filter_tent.wgsl"),
        });
        sources.extend(self.output_sources(self.output));
        sources.push(entry);
        sources
    }

    /// The source of the mapping from workgroups to tiles.
    pub(super) fn tile_order(&self) -> Source {
        if self.tier.deals_workgroups() {
            wgsl!("wgsl/trace/tile_order_interleaved.wgsl")
        } else {
            wgsl!("wgsl/trace/tile_order_linear.wgsl")
        }
    }

    pub(super) fn jitter(&self) -> Source {
        if self.settings.jitter == Jitter::On {
            wgsl!("wgsl/trace/jitter_stratified.wgsl")
        } else {
            wgsl!("wgsl/trace/jitter_none.wgsl")
        }
    }

    pub(super) fn unsampled(&self) -> Source {
        match self.settings.unsampled {
            Unsampled::Nearest => wgsl!("wgsl/supersample/unsampled_nearest.wgsl"),
            Unsampled::Bilinear => wgsl!("wgsl/supersample/unsampled_bilinear.wgsl"),
        }
    }

    /// The sources of a kernel that traces rays, ending with `entry`.
    pub(crate) fn tracing_sources(&self, entry: impl IntoIterator<Item = Source>) -> Vec<Source> {
        self.tracing_sources_with(self.hit(), entry)
    }

    pub(super) fn hit(&self) -> Source {
        let f = &self.features;
        if f.coverage || f.vertex_alpha {
            return wgsl!("wgsl/trace/any_hit_coverage.wgsl");
        }
        match (f.alpha_mask, f.shadow_filter) {
            (true, _) => wgsl!("wgsl/trace/any_hit_alpha.wgsl"),
            (false, true) => wgsl!("wgsl/trace/any_hit_shadow.wgsl"),
            (false, false) => wgsl!("wgsl/trace/any_hit_opaque.wgsl"),
        }
    }

    /// Like [`FrameSpec::tracing_sources`], with `hit` to decide which hits count.
    pub(crate) fn tracing_sources_with(
        &self,
        hit: Source,
        entry: impl IntoIterator<Item = Source>,
    ) -> Vec<Source> {
        self.tracing_sources_from(wgsl!("wgsl/adaptive/attributes_channels.wgsl"), hit, entry)
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
            pick(
                self.secondary,
                wgsl!("wgsl/supersample/secondary_hit.wgsl"),
                wgsl!("wgsl/supersample/secondary_hit_none.wgsl"),
            ),
            pick(
                f.coverage,
                wgsl!("wgsl/shade/straight_coverage.wgsl"),
                wgsl!("wgsl/shade/straight_none.wgsl"),
            ),
            match (f.reflection, f.refraction || f.coverage) {
                (_, true) => wgsl!("wgsl/shade/scatter_dielectric.wgsl"),
                (true, false) => wgsl!("wgsl/shade/scatter_mirror.wgsl"),
                (false, false) => wgsl!("wgsl/shade/scatter_none.wgsl"),
            },
            wgsl!("wgsl/shade/sample.wgsl"),
        ]);
        sources.extend(entry);
        sources
    }

    /// The sources of a kernel that intersects the scene and evaluates surfaces and lights.
    pub(super) fn scene_sources(&self, attributes: Source, hit: Source) -> Vec<Source> {
        let f = &self.features;
        self.shading_sources(
            attributes,
            [
                pick(
                    self.robustness.watertight,
                    wgsl!("wgsl/trace/triangle_edge_exact.wgsl"),
                    wgsl!("wgsl/trace/triangle_edge_rounded.wgsl"),
                ),
                wgsl!("wgsl/trace/triangle.wgsl"),
                pick(
                    self.tier.stores_images(),
                    wgsl!("wgsl/scene/bvh_textures.wgsl"),
                    wgsl!("wgsl/scene/bvh_buffers.wgsl"),
                ),
                wgsl!("wgsl/trace/bvh.wgsl"),
                pick(
                    f.spheres,
                    wgsl!("wgsl/trace/sphere_analytic.wgsl"),
                    wgsl!("wgsl/trace/sphere_none.wgsl"),
                ),
                pick(
                    f.single_sided,
                    wgsl!("wgsl/trace/sides_single.wgsl"),
                    wgsl!("wgsl/trace/sides_both.wgsl"),
                ),
                hit,
                pick(
                    self.averages_textures(),
                    wgsl!("wgsl/trace/ray_cone.wgsl"),
                    wgsl!("wgsl/trace/ray_cone_none.wgsl"),
                ),
                wgsl!("wgsl/trace/surface.wgsl"),
                pick(
                    f.extended_materials,
                    wgsl!("wgsl/trace/surface_maps.wgsl"),
                    wgsl!("wgsl/trace/surface_maps_none.wgsl"),
                ),
            ]
            .into_iter()
            .chain(self.shadow_sources())
            .chain(self.media_sources())
            .chain(self.vertex_sources()),
        )
    }

    fn shadow_sources(&self) -> Vec<Source> {
        let f = &self.features;
        if !f.lights {
            return vec![wgsl!("wgsl/shade/shadow_none.wgsl")];
        }
        vec![
            pick(f.coverage, wgsl!("wgsl/shade/shadow_coverage.wgsl"), wgsl!("wgsl/shade/shadow_rays.wgsl")),
            pick(
                f.smooth_normals,
                wgsl!("wgsl/shade/terminator_smooth.wgsl"),
                wgsl!("wgsl/shade/terminator_flat.wgsl"),
            ),
            pick(
                f.translucency,
                wgsl!("wgsl/shade/translucency_side.wgsl"),
                wgsl!("wgsl/shade/translucency_side_front.wgsl"),
            ),
        ]
    }

    fn media_sources(&self) -> Vec<Source> {
        if self.features.nested_media {
            vec![
                wgsl!("wgsl/media/media_list.wgsl"),
                pick(
                    self.features.extended_materials,
                    wgsl!("wgsl/media/media_absorbing.wgsl"),
                    wgsl!("wgsl/media/media_transparent.wgsl"),
                ),
                wgsl!("wgsl/media/media_boundary.wgsl"),
                wgsl!("wgsl/media/media_trace.wgsl"),
            ]
        } else {
            vec![wgsl!("wgsl/media/media_none.wgsl")]
        }
    }

    fn vertex_sources(&self) -> Vec<Source> {
        if self.settings.specialize != Specialize::All && !self.scene.has_texcoords && !self.scene.has_colors
        {
            return vec![wgsl!("wgsl/scene/vertex_none.wgsl")];
        }
        vec![
            pick(
                self.tier.stores_images(),
                wgsl!("wgsl/scene/vertex_textures.wgsl"),
                wgsl!("wgsl/scene/vertex_buffers.wgsl"),
            ),
            wgsl!("wgsl/scene/vertex_attributes.wgsl"),
        ]
    }

    /// The sources of a kernel that addresses pixels and their attributes.
    pub(super) fn pixel_sources(&self, attributes: Source) -> Vec<Source> {
        vec![
            self.constants(),
            wgsl!("wgsl/trace/frame.wgsl"),
            self.jitter(),
            wgsl!("wgsl/scene/octahedral.wgsl"),
            wgsl!("wgsl/adaptive/attributes.wgsl"),
            pick(
                self.features.extended_materials,
                wgsl!("wgsl/adaptive/maps.wgsl"),
                wgsl!("wgsl/adaptive/maps_none.wgsl"),
            ),
            attributes,
            if self.inspect {
                wgsl!("wgsl/output/inspect_counters.wgsl")
            } else {
                wgsl!("wgsl/output/inspect_none.wgsl")
            },
        ]
    }

    fn shading_sources(&self, attributes: Source, rest: impl IntoIterator<Item = Source>) -> Vec<Source> {
        let f = &self.features;
        let mut sources = self.pixel_sources(attributes);
        sources.extend([
            wgsl!("wgsl/scene/object.wgsl"),
            pick(
                self.tier.stores_images(),
                wgsl!("wgsl/scene/object_textures.wgsl"),
                wgsl!("wgsl/scene/object_buffers.wgsl"),
            ),
        ]);
        if self.tier.stores_images() {
            sources.push(wgsl!("wgsl/scene/storage_texel.wgsl"));
        }
        sources.extend(match (f.textures, self.settings.mip) {
            (false, _) => vec![wgsl!("wgsl/scene/texture_none.wgsl")],
            (true, Mip::Off) => {
                vec![wgsl!("wgsl/scene/texture_atlas.wgsl"), wgsl!("wgsl/scene/texture_plain.wgsl")]
            }
            (true, Mip::On) => {
                vec![wgsl!("wgsl/scene/texture_atlas.wgsl"), wgsl!("wgsl/scene/texture_mip.wgsl")]
            }
        });
        sources.extend([
            wgsl!("wgsl/shade/fresnel.wgsl"),
            pick(
                f.environment_map,
                wgsl!("wgsl/shade/environment_map.wgsl"),
                wgsl!("wgsl/shade/environment_constant.wgsl"),
            ),
            pick(
                f.extended_materials,
                wgsl!("wgsl/shade/material_maps.wgsl"),
                wgsl!("wgsl/shade/material_maps_none.wgsl"),
            ),
            pick(f.coverage, wgsl!("wgsl/shade/coverage_blend.wgsl"), wgsl!("wgsl/shade/coverage_none.wgsl")),
        ]);
        sources.extend(match (f.glossy, f.extended_materials) {
            (_, true) => {
                vec![
                    pick(
                        f.anisotropy,
                        wgsl!("wgsl/shade/anisotropy.wgsl"),
                        wgsl!("wgsl/shade/anisotropy_unread.wgsl"),
                    ),
                    pick(
                        f.iridescence,
                        wgsl!("wgsl/shade/iridescence.wgsl"),
                        wgsl!("wgsl/shade/iridescence_unread.wgsl"),
                    ),
                    pick(
                        f.translucency,
                        wgsl!("wgsl/shade/translucency.wgsl"),
                        wgsl!("wgsl/shade/translucency_unread.wgsl"),
                    ),
                    pick(
                        f.coat_normals,
                        wgsl!("wgsl/shade/coat_normal.wgsl"),
                        wgsl!("wgsl/shade/coat_normal_unread.wgsl"),
                    ),
                    wgsl!("wgsl/shade/material_extended.wgsl"),
                    wgsl!("wgsl/shade/material_layers.wgsl"),
                    wgsl!("wgsl/shade/material.wgsl"),
                ]
            }
            (true, false) => {
                vec![wgsl!("wgsl/shade/material_plain.wgsl"), wgsl!("wgsl/shade/material.wgsl")]
            }
            (false, false) => vec![wgsl!("wgsl/shade/material_matte.wgsl")],
        });
        sources.push(match (f.lights, self.preview) {
            (true, _) => wgsl!("wgsl/shade/lights_punctual.wgsl"),
            (false, true) => wgsl!("wgsl/shade/lights_eye.wgsl"),
            (false, false) => wgsl!("wgsl/shade/lights_none.wgsl"),
        });
        if f.glossy || f.extended_materials {
            if !f.anisotropy {
                sources.push(wgsl!("wgsl/shade/anisotropy_none.wgsl"));
            }
            if !f.iridescence {
                sources.push(wgsl!("wgsl/shade/iridescence_none.wgsl"));
            }
            if !f.translucency {
                sources.push(wgsl!("wgsl/shade/translucency_none.wgsl"));
            }
            if !f.coat_normals {
                sources.push(wgsl!("wgsl/shade/coat_normal_none.wgsl"));
            }
            sources.push(pick(
                f.coat_normals && f.lights,
                wgsl!("wgsl/shade/coat_lights.wgsl"),
                wgsl!("wgsl/shade/coat_dark.wgsl"),
            ));
            sources.push(pick(
                f.translucency && f.lights,
                wgsl!("wgsl/shade/translucency_lights.wgsl"),
                wgsl!("wgsl/shade/translucency_dark.wgsl"),
            ));
            if f.sheen {
                sources.extend([wgsl!("wgsl/shade/lobe_albedos.wgsl"), wgsl!("wgsl/shade/sheen.wgsl")]);
            } else {
                sources.push(wgsl!("wgsl/shade/sheen_none.wgsl"));
            }
            sources.push(pick(
                f.environment_map,
                wgsl!("wgsl/shade/environment_lobes.wgsl"),
                wgsl!("wgsl/shade/environment_lobes_constant.wgsl"),
            ));
        }
        if self.settings.supersamples() {
            sources.extend([
                wgsl!("wgsl/supersample/pixel_edges.wgsl"),
                wgsl!("wgsl/supersample/pixel_edges_record.wgsl"),
            ]);
        } else {
            sources.push(wgsl!("wgsl/supersample/pixel_edges_none.wgsl"));
        }
        let pixels = self.settings.sampling == 1 || self.output == Output::Nowhere;
        sources.extend(self.output_sources(if pixels { self.output } else { Output::Samples }));
        sources.extend(rest);
        sources
    }
}

pub(super) fn pick(present: bool, with: Source, without: Source) -> Source {
    if present { with } else { without }
}

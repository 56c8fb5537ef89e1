//! The stages of a frame and what each is made of.
//!
//! | stage | source | WGSL |
//! | --- | --- | --- |
//! | full | lecture, "trace() in detail" | `passes/full.wgsl` |
//! | base | Kim 2016, 3.2; Table 2, Step-I | `passes/base.wgsl` |
//! | similarity_a1 | Kim 2016, 3.3, 3.4, Table 1; Step-II-a | `passes/similarity_a1.wgsl` |
//! | compact_a1 | Kim 2016, 5; Step-II-b | `passes/compact.wgsl` |
//! | trace_a1 | Kim 2016, Step-II-c | `passes/trace.wgsl` |
//! | similarity_a2 | Kim 2016, Step-III-a | `passes/similarity_a2.wgsl` |
//! | compact_a2 | Kim 2016, Step-III-b | `passes/compact.wgsl` |
//! | trace_a2 | Kim 2016, Step-III-c | `passes/trace.wgsl` |

#[cfg(test)]
mod tests;

use std::fmt::Write as _;

use crate::{
    Features, GpuScene, Linking, MAX_RAYS, Robustness, SAMPLES_PER_SUBMISSION, atlas,
    gpu::shader::Source,
    gpu_scene,
    scene::OCTAHEDRAL_ERROR,
    stats::{CHECK_NAMES, Origin},
};

/// A file of this crate.
macro_rules! wgsl {
    ($path:literal) => {
        $crate::gpu::shader::Source {
            file: $path,
            text: include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/", $path)).into(),
        }
    };
}
pub(crate) use wgsl;

/// A kernel of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Every pixel.
    Full,
    /// Step-I.
    Base,
    /// Step-II-a.
    SimilarityA1,
    /// Step-II-b.
    CompactA1,
    /// Step-II-c.
    TraceA1,
    /// Step-III-a.
    SimilarityA2,
    /// Step-III-b.
    CompactA2,
    /// Step-III-c.
    TraceA2,
}

impl Stage {
    /// Every stage.
    #[cfg(test)]
    pub const ALL: [Self; 8] = [
        Self::Full,
        Self::Base,
        Self::SimilarityA1,
        Self::CompactA1,
        Self::TraceA1,
        Self::SimilarityA2,
        Self::CompactA2,
        Self::TraceA2,
    ];

    /// Its name everywhere: GPU label, timing row.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Base => "base",
            Self::SimilarityA1 => "similarity_a1",
            Self::CompactA1 => "compact_a1",
            Self::TraceA1 => "trace_a1",
            Self::SimilarityA2 => "similarity_a2",
            Self::CompactA2 => "compact_a2",
            Self::TraceA2 => "trace_a2",
        }
    }

    fn entry(self) -> Source {
        match self {
            Self::Full => wgsl!("passes/full.wgsl"),
            Self::Base => wgsl!("passes/base.wgsl"),
            Self::SimilarityA1 => wgsl!("passes/similarity_a1.wgsl"),
            Self::CompactA1 | Self::CompactA2 => wgsl!("passes/compact.wgsl"),
            Self::SimilarityA2 => wgsl!("passes/similarity_a2.wgsl"),
            Self::TraceA1 | Self::TraceA2 => wgsl!("passes/trace.wgsl"),
        }
    }
}

/// Where colours go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// sRGB, 8 bits.
    Display,
    /// Linear radiance, 32-bit floating point.
    Linear,
}

/// What decides which pieces a kernel is made of. The only place that chooses files.
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

/// Threads of a workgroup that works through a list.
pub const TRACE_GROUP: u32 = 64;
/// Workgroups along x; a longer list goes on along y.
pub const TRACE_ROW: u32 = 32_768;

/// By what share of the distance a box grows on all sides in the traversal, so that it loses no hit of what is inside.
/// With `e = 2^-24` (half a unit in the last place), WGSL's 5 e for a quotient and `D`, the largest distance from the ray's
/// origin to a plane of the node along an axis, rounding moves
///
/// | what | by at most |
/// | --- | --- |
/// | corners from the ray, across it: their difference to the origin and its share of the shear, the shear, its product, the difference | 1 + 1 + 5 + 1 + 2 = 10 e D |
/// | a plane from the ray: `p - o`, its product, the quotient, `q 2^e / d`, the sum, the margin's own sum | 1 + 1 + 5 + 2 + 1 + 1 = 11 e D |
/// | the distance of a hit within its box: corner, sum and reciprocal of the weights, products, sum, `1 / d` | 1 + 2 + 5 + 2 + 2 + 6 = 18 e D |
/// | two hits at the same distance, of which the second must be looked at too | 8 e D |
///
/// together 47 e D; it is 48.
pub const BVH_ROUNDING: f32 = 48.0 / 16_777_216.0;
/// How far off their face new rays start: `OFFSET_COORDINATES |n| . |corners| + OFFSET_SIZE size`, so that the next test of
/// the same triangle, or of one beside it in its plane and not much larger, finds it behind the ray. With `e = 2^-24`:
///
/// | what moves along the normal | by at most |
/// | --- | --- |
/// | the point by its last sum, the origin by its own | 2 e coordinates |
/// | the point by the sides, their products, their sum | 5 e size |
/// | the corners in the next test across the ray, both axes ([`BVH_ROUNDING`]) | 1.42 x 10 e size |
/// | the distance that it finds | 18 e size |
///
/// The first is doubled for normals of slivers, which lean; the others together are 37.2 e and 40 e are taken.
pub const OFFSET_COORDINATES: f32 = 4.0 / 16_777_216.0;
pub const OFFSET_SIZE: f32 = 40.0 / 16_777_216.0;

/// Two hits at distances that differ by no more than this share count as one, and the lower object has it.
pub const SAME_DISTANCE: f32 = 4.0 / 16_777_216.0;

/// Counters of an inspected frame: first index and how many.
pub const COUNTER_RAYS: usize = 0;
pub const COUNTER_NODE_VISITS: usize = 4;
pub const COUNTER_PRIMITIVE_TESTS: usize = 5;
pub const COUNTER_ORIGINS: usize = 6;
pub const COUNTER_FAILED: usize = 10;
/// Words of all counters, low and high.
pub const COUNTER_WORDS: usize = 64;

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
    fn shadow_shift(&self) -> Option<u32> {
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

    /// Numbers that both sides need, as WGSL constants.
    fn constants(&self) -> Source {
        let f = &self.features;
        let mut text = String::new();
        let planes = self.planes();
        for name in ["DEPTH", "OBJECT", "NORMAL", "SHADOW", "FACE", "GCOL", "TEXCOORD", "COLOR"] {
            let index = planes.iter().position(|p| *p == name).unwrap_or(0);
            let _ = writeln!(text, "const PLANE_{name}: u32 = {index}u;");
        }
        let flags = [
            ("HAS_LIGHTS", f.lights),
            ("HAS_SHADOW_WORD", self.shadow_shift().is_none()),
            ("HAS_FACE", f.smooth_normals),
            ("HAS_GCOL", f.reflection || f.refraction),
            ("HAS_TEXTURES", f.textures),
            ("HAS_METALLIC_ROUGHNESS_TEXTURES", f.metallic_roughness_textures),
            ("HAS_EMISSIVE_TEXTURES", f.emissive_textures),
            ("HAS_COLORS", f.vertex_colors),
            ("VERTEX_HAS_TEXCOORDS", self.has_texcoords),
            ("VERTEX_HAS_COLORS", self.has_colors),
            ("HAS_PANES", self.has_panes),
        ];
        for (name, value) in flags {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        let numbers = [
            ("BVH_STACK", self.bvh_stack),
            // Each level leaves at most one branch for later, the last one none; two are put down at a time.
            ("BOUNCE_STACK", self.depth + 1),
            ("MAX_RAYS", MAX_RAYS),
            ("LIGHT_COUNT", self.lights),
            ("SHADOW_SHIFT", self.shadow_shift().unwrap_or(0)),
            ("OBJECT_MASK", self.shadow_shift().map_or(u32::MAX, |shift| (1 << shift) - 1)),
            ("TRACE_GROUP", TRACE_GROUP),
            ("TRACE_ROW", TRACE_ROW),
            ("CHUNK_SAMPLES", SAMPLES_PER_SUBMISSION),
            ("ORIGIN_BASE", Origin::Base as u32),
            ("ORIGIN_TRACED_A1", Origin::TracedA1 as u32),
            ("ORIGIN_TRACED_A2", Origin::TracedA2 as u32),
            ("ORIGIN_INTERPOLATED", Origin::Interpolated as u32),
            ("TEXTURE_NEAREST", atlas::TEXTURE_NEAREST),
            ("TEXTURE_PRESENT", atlas::TEXTURE_PRESENT),
            ("WRAP_REPEAT", atlas::WRAP_REPEAT),
            ("WRAP_MIRROR", atlas::WRAP_MIRROR),
            ("SURFACE_OBJECT", gpu_scene::SURFACE_OBJECT),
            ("SURFACE_NO_SHADOW", gpu_scene::SURFACE_NO_SHADOW),
            ("SURFACE_ALPHA", gpu_scene::SURFACE_ALPHA),
            ("OBJECT_UNLIT", gpu_scene::OBJECT_UNLIT),
            ("OBJECT_THIN", gpu_scene::OBJECT_THIN),
            ("OBJECT_WEIGHTS", gpu_scene::OBJECT_WEIGHTS),
            ("OBJECT_MATTE", gpu_scene::OBJECT_MATTE),
            ("LIGHT_DIRECTIONAL", gpu_scene::LIGHT_DIRECTIONAL),
            ("LIGHT_CONSTANT", gpu_scene::LIGHT_CONSTANT),
            ("RAY_PRIMARY", 0),
            ("RAY_SHADOW", 1),
            ("RAY_REFLECTION", 2),
            ("RAY_REFRACTION", 3),
            ("COUNTER_RAYS", COUNTER_RAYS as u32),
            ("COUNTER_NODE_VISITS", COUNTER_NODE_VISITS as u32),
            ("COUNTER_PRIMITIVE_TESTS", COUNTER_PRIMITIVE_TESTS as u32),
            ("COUNTER_ORIGINS", COUNTER_ORIGINS as u32),
            ("COUNTER_FAILED", COUNTER_FAILED as u32),
        ];
        for (name, value) in numbers {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        let reals = [
            ("BVH_ROUNDING", if self.robustness.boxes { BVH_ROUNDING } else { 0.0 }),
            ("OFFSET_COORDINATES", if self.robustness.offset { OFFSET_COORDINATES } else { 0.0 }),
            ("OFFSET_SIZE", if self.robustness.offset { OFFSET_SIZE } else { 0.0 }),
            // Rays that pass straight on need one order of the surfaces, without a tolerance.
            ("SAME_DISTANCE", if self.has_panes { 0.0 } else { SAME_DISTANCE }),
            ("SPHERE_MARK", gpu_scene::SPHERE_MARK),
            ("NORMAL_ERROR", OCTAHEDRAL_ERROR),
        ];
        for (name, value) in reals {
            let _ = writeln!(text, "const {name}: f32 = {value:e};");
        }
        for (bit, name) in CHECK_NAMES.iter().enumerate() {
            let _ = writeln!(text, "const CHECK_{}: u32 = {}u;", name.to_uppercase(), 1 << bit);
        }
        Source { file: "(constants)", text: text.into() }
    }
}

//! Numbers that both sides need: each stands here (or where Rust uses it most) and is written into the WGSL.

use std::fmt::Write as _;

use super::{FrameSpec, PATH_TILE, postcorrect, spec::CHANNELS};
use crate::{
    DirectLight, Foveation, MAX_RAYS, Postcorrect, Roulette, SAMPLES_PER_SUBMISSION, Specialize, StereoReuse,
    device::atlas,
    device::gpu_scene,
    device::{self, shader::Source},
    frame::counters::{COUNTER_WORDS, GROUPS, Group},
    frame::sequence::{RANK_TILE, RANKS},
    scene::OCTAHEDRAL_ERROR,
};

/// Threads of a workgroup that works through a list.
pub const TRACE_GROUP: u32 = 64;
/// Workgroups along x; a longer list goes on along y.
pub const TRACE_ROW: u32 = 32_768;

/// Samples that a refined pixel gets at once, and in all.
pub const REFINE_STEP: u32 = 4;
pub const REFINE_MOST: u32 = 16;
/// Words of what is known of a pixel that is refined: four samples and a sum.
pub const REFINE_WORDS: u32 = 15;
/// What subpixels must exceed the least threshold by for the cells between them to get samples.
pub const STRATUM_CONTRAST: f32 = 2.0;

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

/// Footprints whose longer axis is so many texels of the level in which one texel is as wide as the shorter axis, or longer,
/// are taken for wider ones.
pub const TEXTURE_MOST_LENGTH: f32 = 5.0;
/// Up to where points lie along the longer and the shorter axis, squared, in units of their distance: 9 points and 3.
pub const TEXTURE_LONGEST: f32 = 81.0;
pub const TEXTURE_WIDEST: f32 = 9.0;
/// One over the part of a level, in its logarithm, in which the next one sets in.
pub const TEXTURE_STEPS: f32 = 4.0;
/// log2 of the second moments of footprints that are stored, in texture coordinates: from a quarter of a texel of the
/// largest image to more than [`CONE_MOST`].
pub const FOOTPRINT_LEAST: f32 = -32.0;
pub const FOOTPRINT_MOST: f32 = 10.0;
/// Surfaces are seen at no smaller cosine, footprints reach over no more of a texture (which is its smallest level many
/// times over), and cones grow by no more: everything stays finite.
pub const CONE_LEAST_COSINE: f32 = 1.0e-4;
pub const CONE_MOST: f32 = 16.0;
pub const CONE_MOST_GROWTH: f32 = 8.0;

impl FrameSpec {
    /// Numbers that both sides need, as WGSL constants.
    pub(super) fn constants(&self) -> Source {
        let f = &self.features;
        let mut text = String::new();
        let channels = self.channels();
        for (name, _) in CHANNELS {
            let index = channels.iter().position(|p| p == name).unwrap_or(0);
            let _ = writeln!(text, "const CHANNEL_{name}: u32 = {index}u;");
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
            ("HAS_FOOTPRINT", self.averages_textures()),
            ("HAS_EMISSION", f.emission),
            ("HAS_PANES", f.panes),
            ("HAS_REFLECTION", f.reflection),
            ("HAS_REFRACTION", f.refraction),
            ("WEIGHS_EMITTERS", self.settings.paths.direct_light == DirectLight::Mis),
            ("STEREO_REUSE_UNWEIGHTED", self.settings.paths.stereo_reuse == StereoReuse::Paper),
            ("ROULETTE", self.settings.paths.roulette == Roulette::On),
            ("FOVEATION_COMPENSATED", self.settings.paths.foveation == Foveation::Compensated),
            ("LIGHT_COUNT_KNOWN", self.settings.specialize == Specialize::Auto),
            ("VERTEX_STRIDE_KNOWN", self.settings.specialize == Specialize::Auto),
            ("COUNTS", self.inspect),
            ("HAS_RECORDS", self.records),
            ("HAS_POSTCORRECTION", self.postcorrects()),
            ("COMPARES_SHADOWS", self.settings.postcorrect != Postcorrect::Objects),
        ];
        for (name, value) in flags {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        let rng = [
            ("CHANNELS", self.stored_channels()),
            ("SAMPLING", self.settings.sampling),
            ("BVH_STACK", self.scene.bvh_stack),
            // Each level leaves at most one branch for later, the last one none; two are put down at a time.
            ("SCATTER_STACK", self.settings.depth + 1),
            ("MAX_RAYS", MAX_RAYS),
            ("LIGHT_COUNT", self.scene.lights),
            ("VERTEX_STRIDE", 6 * u32::from(self.scene.has_texcoords) + 3 * u32::from(self.scene.has_colors)),
            ("SHADOW_SHIFT", self.shadow_shift().unwrap_or(0)),
            ("OBJECT_MASK", self.shadow_shift().map_or(u32::MAX, |shift| (1 << shift) - 1)),
            ("TRACE_GROUP", TRACE_GROUP),
            ("TRACE_ROW", TRACE_ROW),
            ("STORAGE_TEXTURE_WIDTH", device::STORAGE_TEXTURE_WIDTH),
            ("CHUNK_SAMPLES", SAMPLES_PER_SUBMISSION),
            ("PIXEL_EDGES_FIRST", channels.len() as u32),
            ("PIXEL_EDGE_CHANNELS", self.pixel_edge_channels()),
            ("PIXEL_EDGE_SECONDARY", 2),
            ("PIXEL_EDGE_COLOR", self.pixel_edge_round() - 3),
            ("PIXEL_EDGE_ROUND", self.pixel_edge_round()),
            ("PIXEL_EDGES_APRON", u32::from(!self.interpolates())),
            ("ROUND_SAMPLES", postcorrect::ROUND_SAMPLES),
            ("TEXTURE_PAGE", atlas::MAX_PAGES - 1),
            ("RANKS", RANKS),
            ("RANK_TILE", RANK_TILE),
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
            ("REFINE_STEP", REFINE_STEP),
            ("REFINE_MOST", REFINE_MOST),
            ("REFINE_WORDS", REFINE_WORDS),
            ("REFINE_FIRST", (1 << REFINE_STEP) - 1),
            ("PATH_TILE", PATH_TILE),
            ("LIGHT_SAMPLES", self.settings.paths.light_samples),
            ("FOVEATION_LEVEL", self.settings.paths.foveation_level()),
        ];
        for (name, value) in rng {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        let reals = [
            ("BVH_ROUNDING", if self.robustness.boxes { BVH_ROUNDING } else { 0.0 }),
            ("OFFSET_COORDINATES", if self.robustness.offset { OFFSET_COORDINATES } else { 0.0 }),
            ("OFFSET_SIZE", if self.robustness.offset { OFFSET_SIZE } else { 0.0 }),
            // Rays that pass straight on need one order of the surfaces, without a tolerance.
            ("SAME_DISTANCE", if self.has_panes { 0.0 } else { SAME_DISTANCE }),
            ("STRATUM_CONTRAST", STRATUM_CONTRAST),
            ("SPHERE_MARK", gpu_scene::SPHERE_MARK),
            ("NORMAL_ERROR", OCTAHEDRAL_ERROR),
            ("FOOTPRINT_LEAST", FOOTPRINT_LEAST),
            ("FOOTPRINT_MOST", FOOTPRINT_MOST),
            ("TEXTURE_MOST_LENGTH", TEXTURE_MOST_LENGTH),
            ("TEXTURE_LONGEST", TEXTURE_LONGEST),
            ("TEXTURE_WIDEST", TEXTURE_WIDEST),
            ("TEXTURE_STEPS", TEXTURE_STEPS),
            ("CONE_LEAST_COSINE", CONE_LEAST_COSINE),
            ("CONE_MOST", CONE_MOST),
            ("CONE_MOST_GROWTH", CONE_MOST_GROWTH),
        ];
        for (name, value) in reals {
            let _ = writeln!(text, "const {name}: f32 = {value:e};");
        }
        let _ = writeln!(text, "const COUNTER_WORDS: u32 = {COUNTER_WORDS}u;");
        for group in GROUPS {
            let Group { name, prefix, first, names, bits } = group;
            let _ = writeln!(text, "const COUNTER_{name}: u32 = {first}u;");
            let _ = writeln!(text, "const {prefix}_COUNT: u32 = {}u;", names.len());
            for (index, name) in names.iter().enumerate() {
                let value = if bits { 1 << index } else { index };
                let _ = writeln!(text, "const {prefix}_{}: u32 = {value}u;", name.to_uppercase());
            }
        }
        Source { file: "(constants)", text: text.into() }
    }
}

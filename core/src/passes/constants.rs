//! Numeric constants shared with the shaders: each is defined here, or where Rust uses it most, and generated as
//! WGSL.

use std::fmt::Write as _;

use super::{FrameSpec, PATH_TILE, postcorrect, spec::CHANNELS};
use crate::{
    DirectLight, Foveation, MAX_RAYS, Postcorrect, Roulette, SAMPLES_PER_SUBMISSION, Specialize, StereoReuse,
    device::atlas,
    device::gpu_scene::{self, SceneFacts},
    device::material_records,
    device::{self, shader::Source},
    frame::counters::{COUNTER_WORDS, GROUPS, Group},
    frame::sequence::{RANK_TILE, RANKS},
    scene::{self, OCTAHEDRAL_ERROR, TextureSlot},
};

/// Threads in a workgroup that processes entries of a list.
pub const TRACE_GROUP: u32 = 64;

/// Flag in an object's word of attributes, below that of traced pixels: its mirrored ray met nothing.
const MIRROR_FLAG: u32 = 1 << 30;
/// Largest number of workgroups along x; more continue in the next row along y.
pub const TRACE_ROW: u32 = 32_768;

/// Samples that a refined pixel gets per step, and the most that it gets in total.
pub const REFINE_STEP: u32 = 4;
pub const REFINE_MOST: u32 = 16;
/// Words of a refined pixel's state in the list buffer: four RGB samples and the sum of all, three words each.
pub const REFINE_WORDS: u32 = 15;
/// Factor on the smallest threshold: cells of a refined pixel get a sample if its subpixels differ by more.
pub const STRATUM_CONTRAST: f32 = 2.0;

/// The most solids that a point is known to lie in.
const MEDIA_MOST: u32 = 8;

/// Mask of the index of a ray's counter in its kind; the bits above hold the roughness of the surface that it left.
const RAY_KIND: u32 = 0xff;

/// Margin by which the traversal enlarges bounding boxes on all sides, relative to the distance, so that rounding
/// never loses a hit inside the box. Let `e = 2^-24` (half a unit in the last place), with WGSL's error of 5 e
/// for a quotient, and let `D` be the largest distance along an axis from the ray's origin to a plane of the
/// node. In units of `e D`, the errors are at most:
///
/// - corners across the ray: 1 + 1 + 5 + 1 + 2 = 10, from the difference to the origin and its share of the
///   shear, the shear, its product and the difference;
/// - planes along the ray: 1 + 1 + 5 + 2 + 1 + 1 = 11, from `p - o`, its product, the quotient, `q 2^e / d`, the
///   sum and the margin's own sum;
/// - the distance of a hit in the box: 1 + 2 + 5 + 2 + 2 + 6 = 18, from the corner, the sum and reciprocal of the
///   weights, the products, the sum and `1 / d`;
/// - two hits that count as equally far, both of which must be tested: 8.
///
/// The sum is 47, rounded up to 48.
pub const BVH_ROUNDING: f32 = 48.0 / 16_777_216.0;
/// Distance of a new ray's origin from the triangle that it starts on, in the sum `OFFSET_COORDINATES |n| .
/// |corners|` plus `OFFSET_SIZE size`. It is large enough that the intersection test finds the same triangle, or
/// a coplanar neighbour that is not much larger, behind the origin. With `e = 2^-24`, errors along the normal are
/// at most:
///
/// - the hit point and the origin by their last sums: 2 e times the coordinates;
/// - the hit point by the sides, their products and their sum: 5 e times the size;
/// - the corners across the ray in the next test, along both axes ([`BVH_ROUNDING`]): 1.42 x 10 e times the size;
/// - the distance that this test finds: 18 e times the size.
///
/// The first bound is doubled, as normals of slivers are inaccurate; the others sum to 37.2 e, rounded up to 40
/// e.
pub const OFFSET_COORDINATES: f32 = 4.0 / 16_777_216.0;
pub const OFFSET_SIZE: f32 = 40.0 / 16_777_216.0;

/// Relative difference up to which two hit distances count as equal; the hit with the lower OID then wins.
pub const SAME_DISTANCE: f32 = 4.0 / 16_777_216.0;

/// Longest footprint axis, in texels of the level whose texels are as wide as the shorter axis. Longer footprints
/// are sampled from a coarser level.
pub const TEXTURE_MOST_LENGTH: f32 = 5.0;
/// Squares of the largest lengths of the longer and the shorter axis in sample spacings: at most 9 x 3 points.
pub const TEXTURE_LONGEST: f32 = 81.0;
pub const TEXTURE_WIDEST: f32 = 9.0;
/// Reciprocal of the part of a level, on the logarithmic scale, over which the next level is blended in.
pub const TEXTURE_STEPS: f32 = 4.0;
/// Range of log2 of stored second moments of footprints, in squared texture coordinates: from a quarter of a
/// texel of the largest image to more than [`CONE_MOST`].
pub const FOOTPRINT_LEAST: f32 = -32.0;
pub const FOOTPRINT_MOST: f32 = 10.0;
/// Limits that keep ray cones finite: the smallest cosine at a surface, the widest footprint in texture
/// coordinates (many times the smallest mip level), and the largest growth of a cone at a surface.
pub const CONE_LEAST_COSINE: f32 = 1.0e-4;
pub const CONE_MOST: f32 = 16.0;
pub const CONE_MOST_GROWTH: f32 = 8.0;

impl FrameSpec {
    /// Generates the constants that Rust and the shaders share as WGSL.
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
            ("HAS_GCOL", f.secondary_rays()),
            ("MIRRORS_ENVIRONMENT", self.mirrors_environment()),
            ("HAS_TEXTURES", f.textures),
            ("HAS_METALLIC_ROUGHNESS_TEXTURES", f.metallic_roughness_textures),
            ("HAS_EMISSIVE_TEXTURES", f.emissive_textures),
            ("HAS_COLORS", f.vertex_colors),
            ("HAS_FOOTPRINT", self.averages_textures()),
            ("HAS_EMISSION", f.emission),
            ("HAS_NORMAL_MAPS", f.normal_maps),
            ("HAS_TANGENTS", f.tangents),
            ("HAS_SLOT_COORDINATES", f.slot_coordinates),
            ("HAS_LAYERS", f.layers),
            ("HAS_SHEEN", f.sheen),
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
            // Each level but the last leaves at most one branch for later, two where rays also go straight on; a
            // level pushes one more.
            ("SCATTER_STACK", (1 + u32::from(f.coverage)) * self.settings.depth + 1),
            // Solids beyond the depth of the recursion are not told apart.
            ("MEDIA_MOST", self.settings.depth.clamp(2, MEDIA_MOST)),
            ("MAX_RAYS", MAX_RAYS),
            ("LIGHT_COUNT", self.scene.lights),
            ("VERTEX_STRIDE", SceneFacts::vertex_stride(self.scene.has_texcoords, self.scene.has_colors)),
            ("ATTRIBUTES_MIRROR", if self.mirrors_environment() { MIRROR_FLAG } else { 0 }),
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
            ("SURFACE_BLEND", gpu_scene::SURFACE_BLEND),
            ("SURFACE_SINGLE_SIDED", gpu_scene::SURFACE_SINGLE_SIDED),
            ("SURFACE_NO_SHADOW", gpu_scene::SURFACE_NO_SHADOW),
            ("SURFACE_ALPHA", gpu_scene::SURFACE_ALPHA),
            ("OBJECT_UNLIT", gpu_scene::OBJECT_UNLIT),
            ("OBJECT_THIN", gpu_scene::OBJECT_THIN),
            ("OBJECT_WEIGHTS", gpu_scene::OBJECT_WEIGHTS),
            ("OBJECT_MATTE", gpu_scene::OBJECT_MATTE),
            ("OBJECT_BLEND", gpu_scene::OBJECT_BLEND),
            ("OBJECT_EXTENDED", gpu_scene::OBJECT_EXTENDED),
            ("OBJECT_SOLID", gpu_scene::OBJECT_SOLID),
            ("OBJECT_CLEAR", gpu_scene::OBJECT_CLEAR),
            ("OBJECT_PRIORITY_SHIFT", gpu_scene::OBJECT_PRIORITY_SHIFT),
            ("RECORD_SLOTS", material_records::RECORD_SLOTS),
            ("SLOT_PARTS", material_records::SLOT_PARTS),
            ("RECORD_SPECULAR_GLOSSINESS", material_records::RECORD_SPECULAR_GLOSSINESS),
            ("RECORD_NORMAL_MAP", material_records::RECORD_NORMAL_MAP),
            ("RECORD_ANISOTROPY", material_records::RECORD_ANISOTROPY),
            ("RECORD_IRIDESCENCE", material_records::RECORD_IRIDESCENCE),
            ("RECORD_TRANSLUCENCY", material_records::RECORD_TRANSLUCENCY),
            ("RECORD_DISPERSION", material_records::RECORD_DISPERSION),
            ("SET_FIRST", material_records::SET_FIRST),
            ("SET_SECOND", material_records::SET_SECOND),
            ("LIGHT_DIRECTIONAL", gpu_scene::LIGHT_DIRECTIONAL),
            ("LIGHT_CONSTANT", gpu_scene::LIGHT_CONSTANT),
            ("RAY_KIND", RAY_KIND),
            ("ENVIRONMENT_FILTERED", scene::FIRST_FILTERED),
            ("ALBEDO_SIDE", scene::ALBEDO_SIDE as u32),
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
        for slot in TextureSlot::ALL {
            let _ =
                writeln!(text, "const SLOT_{}: u32 = {}u;", format!("{slot:?}").to_uppercase(), slot as u32);
        }
        let reals = [
            ("BVH_ROUNDING", if self.robustness.boxes { BVH_ROUNDING } else { 0.0 }),
            ("OFFSET_COORDINATES", if self.robustness.offset { OFFSET_COORDINATES } else { 0.0 }),
            ("OFFSET_SIZE", if self.robustness.offset { OFFSET_SIZE } else { 0.0 }),
            // With panes, rays pass straight through surfaces and need a strict order of hits, without a
            // tolerance.
            ("SAME_DISTANCE", if self.has_panes { 0.0 } else { SAME_DISTANCE }),
            ("ENVIRONMENT_LOBE", (scene::FIRST_FILTERED as f32) / scene::WIDEST_LOBE),
            ("STRATUM_CONTRAST", STRATUM_CONTRAST),
            ("LEAST_ROUGHNESS", scene::LEAST_ROUGHNESS),
            ("LEAST_SHEEN_ROUGHNESS", scene::LEAST_SHEEN_ROUGHNESS),
            ("DISPERSION_STEP", scene::DISPERSION_STEP),
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

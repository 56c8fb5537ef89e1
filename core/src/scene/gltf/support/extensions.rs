//! The extensions of Khronos' registry, drafts included, and a few of vendors that change nothing that is shown.

use serde_json::Value;

use super::table::{
    ACCESSORS, BUFFER_VIEWS, BUFFERS, IMAGE_BASED_LIGHTS, IMAGES, LIGHTS, MATERIALS, NORMAL_TEXTURE_INFO,
    TEXTURE_INFO,
};
use super::{Extension, Object, Site, ignored, ignored_extension, needed_extension, object, shown};
use super::{not_shown_extension, present, shown_extension};

pub(super) static EXTENSIONS: [Extension; 56] = [
    // What animates, sounds, reacts, falls or informs changes nothing of the pose that the file rests in.
    ignored_extension("AGI_articulations"),
    ignored_extension("AGI_stk_metadata"),
    ignored_extension("EXT_instance_features"),
    not_shown_extension("EXT_lights_ies", present),
    shown_extension("EXT_lights_image_based").object(&IMAGE_BASED_LIGHT_OF_SCENE),
    ignored_extension("EXT_mesh_features"),
    shown_extension("EXT_mesh_gpu_instancing").object(&INSTANCING),
    ignored_extension("EXT_mesh_manifold"),
    shown_extension("EXT_meshopt_compression").object(&MESHOPT),
    ignored_extension("EXT_structural_metadata"),
    not_shown_extension("EXT_texture_avif", replaces_no_source).object(&TEXTURE_SOURCE),
    not_shown_extension("EXT_texture_procedurals_mx_1_39", present),
    if cfg!(feature = "webp") {
        shown_extension("EXT_texture_webp")
    } else {
        not_shown_extension("EXT_texture_webp", replaces_no_source)
    }
    .object(&TEXTURE_SOURCE),
    ignored_extension("FB_geometry_metadata"),
    ignored_extension("GODOT_single_root"),
    needed_extension("KHR_accessor_float64", present),
    not_shown_extension("KHR_animation_pointer", present),
    ignored_extension("KHR_audio_emitter"),
    ignored_extension("KHR_audio_graph"),
    ignored_extension("KHR_collision_shapes"),
    if cfg!(feature = "draco") {
        shown_extension("KHR_draco_mesh_compression")
    } else {
        needed_extension("KHR_draco_mesh_compression", has_no_other_positions)
    }
    .object(&DRACO),
    not_shown_extension("KHR_gaussian_splatting", present),
    ignored_extension("KHR_implicit_shapes"),
    ignored_extension("KHR_interactivity"),
    shown_extension("KHR_lights_punctual").object(&LIGHT_OF_NODE),
    shown_extension("KHR_materials_anisotropy").object(&ANISOTROPY),
    shown_extension("KHR_materials_clearcoat").object(&CLEARCOAT),
    shown_extension("KHR_materials_diffuse_transmission").object(&DIFFUSE_TRANSMISSION),
    shown_extension("KHR_materials_dispersion").object(&DISPERSION),
    shown_extension("KHR_materials_emissive_strength").object(&EMISSIVE_STRENGTH),
    shown_extension("KHR_materials_ior").object(&IOR),
    shown_extension("KHR_materials_iridescence").object(&IRIDESCENCE),
    shown_extension("KHR_materials_pbrSpecularGlossiness").object(&SPECULAR_GLOSSINESS),
    shown_extension("KHR_materials_sheen").object(&SHEEN),
    shown_extension("KHR_materials_specular").object(&SPECULAR),
    not_shown_extension("KHR_materials_subsurface", present),
    shown_extension("KHR_materials_transmission").object(&TRANSMISSION),
    shown_extension("KHR_materials_unlit"),
    shown_extension("KHR_materials_variants").object(&VARIANTS),
    shown_extension("KHR_materials_volume").object(&VOLUME),
    // The draft renamed the colour.
    not_shown_extension("KHR_materials_volume_scatter", |e, _| {
        ["multiscatterColor", "multiscatterColorFactor"].into_iter().any(|color| differs(e, color, 0.0))
    }),
    shown_extension("KHR_mesh_quantization"),
    shown_extension("KHR_meshopt_compression").object(&MESHOPT),
    ignored_extension("KHR_node_hoverability"),
    ignored_extension("KHR_node_selectability"),
    shown_extension("KHR_node_visibility").object(&VISIBILITY),
    ignored_extension("KHR_physics_rigid_bodies"),
    ignored_extension("KHR_techniques_webgl"),
    if cfg!(feature = "ktx2") {
        shown_extension("KHR_texture_basisu")
    } else {
        not_shown_extension("KHR_texture_basisu", replaces_no_source)
    }
    .object(&TEXTURE_SOURCE),
    not_shown_extension("KHR_texture_procedurals", present),
    shown_extension("KHR_texture_transform").object(&TEXTURE_TRANSFORM),
    not_shown_extension("KHR_texture_video", present),
    ignored_extension("KHR_xmp"),
    ignored_extension("KHR_xmp_json_ld"),
    ignored_extension("MSFT_lod"),
    not_shown_extension("MSFT_texture_dds", replaces_no_source),
];

static ANISOTROPY: Object = object(
    "KHR_materials_anisotropy",
    &[
        shown("anisotropyRotation"),
        shown("anisotropyStrength"),
        shown("anisotropyTexture").object(&TEXTURE_INFO),
    ],
);
static CLEARCOAT: Object = object(
    "KHR_materials_clearcoat",
    &[
        shown("clearcoatFactor"),
        shown("clearcoatNormalTexture").object(&NORMAL_TEXTURE_INFO),
        shown("clearcoatRoughnessFactor"),
        shown("clearcoatRoughnessTexture").object(&TEXTURE_INFO),
        shown("clearcoatTexture").object(&TEXTURE_INFO),
    ],
);
static DIFFUSE_TRANSMISSION: Object = object(
    "KHR_materials_diffuse_transmission",
    &[
        shown("diffuseTransmissionColorFactor"),
        shown("diffuseTransmissionColorTexture").object(&TEXTURE_INFO),
        shown("diffuseTransmissionFactor"),
        shown("diffuseTransmissionTexture").object(&TEXTURE_INFO),
    ],
);
static DISPERSION: Object = object("KHR_materials_dispersion", &[shown("dispersion")]);
static DRACO: Object =
    object("KHR_draco_mesh_compression", &[shown("attributes"), shown("bufferView").index(&BUFFER_VIEWS)]);
static EMISSIVE_STRENGTH: Object = object("KHR_materials_emissive_strength", &[shown("emissiveStrength")]);
static IMAGE_BASED_LIGHT_OF_SCENE: Object =
    object("EXT_lights_image_based", &[shown("light").index(&IMAGE_BASED_LIGHTS)]);
pub(super) static IMAGE_BASED_LIGHT: Object = object(
    "EXT_lights_image_based.light",
    &[
        shown("intensity"),
        shown("irradianceCoefficients"),
        shown("rotation"),
        shown("specularImageSize"),
        shown("specularImages").indices(&IMAGES),
    ],
);
static INSTANCING: Object =
    object("EXT_mesh_gpu_instancing", &[shown("attributes").object(&INSTANCING_ATTRIBUTES)]);
static INSTANCING_ATTRIBUTES: Object = object(
    "EXT_mesh_gpu_instancing.attributes",
    &[
        shown("ROTATION").index(&ACCESSORS),
        shown("SCALE").index(&ACCESSORS),
        shown("TRANSLATION").index(&ACCESSORS),
    ],
);
static IOR: Object = object("KHR_materials_ior", &[shown("ior")]);
static IRIDESCENCE: Object = object(
    "KHR_materials_iridescence",
    &[
        shown("iridescenceFactor"),
        shown("iridescenceIor"),
        shown("iridescenceTexture").object(&TEXTURE_INFO),
        shown("iridescenceThicknessMaximum"),
        shown("iridescenceThicknessMinimum"),
        shown("iridescenceThicknessTexture").object(&TEXTURE_INFO),
    ],
);
static LIGHT_OF_NODE: Object = object("KHR_lights_punctual", &[shown("light").index(&LIGHTS)]);
pub(super) static LIGHT: Object = object(
    "KHR_lights_punctual.light",
    &[
        shown("color"),
        shown("intensity"),
        ignored("name"),
        shown("range"),
        shown("spot").object(&SPOT),
        shown("type"),
    ],
);
static MESHOPT: Object = object(
    "EXT_meshopt_compression",
    &[
        shown("buffer").index(&BUFFERS),
        shown("byteLength"),
        shown("byteOffset"),
        shown("byteStride"),
        shown("count"),
        shown("fallback"),
        shown("filter"),
        shown("mode"),
    ],
);
static SHEEN: Object = object(
    "KHR_materials_sheen",
    &[
        shown("sheenColorFactor"),
        shown("sheenColorTexture").object(&TEXTURE_INFO),
        shown("sheenRoughnessFactor"),
        shown("sheenRoughnessTexture").object(&TEXTURE_INFO),
    ],
);
static SPECULAR: Object = object(
    "KHR_materials_specular",
    &[
        shown("specularColorFactor"),
        shown("specularColorTexture").object(&TEXTURE_INFO),
        shown("specularFactor"),
        shown("specularTexture").object(&TEXTURE_INFO),
    ],
);
static SPECULAR_GLOSSINESS: Object = object(
    "KHR_materials_pbrSpecularGlossiness",
    &[
        shown("diffuseFactor"),
        shown("diffuseTexture").object(&TEXTURE_INFO),
        shown("glossinessFactor"),
        shown("specularFactor"),
        shown("specularGlossinessTexture").object(&TEXTURE_INFO),
    ],
);
static SPOT: Object =
    object("KHR_lights_punctual.light.spot", &[shown("innerConeAngle"), shown("outerConeAngle")]);
static TEXTURE_SOURCE: Object = object("texture", &[shown("source").index(&IMAGES)]);
static TEXTURE_TRANSFORM: Object =
    object("KHR_texture_transform", &[shown("offset"), shown("rotation"), shown("scale"), shown("texCoord")]);
static VARIANTS: Object =
    object("KHR_materials_variants", &[shown("mappings").objects(&VARIANT_MAPPING), shown("variants")]);
static VARIANT_MAPPING: Object = object(
    "KHR_materials_variants.mapping",
    &[shown("material").index(&MATERIALS), ignored("name"), shown("variants")],
);
static TRANSMISSION: Object = object(
    "KHR_materials_transmission",
    &[shown("transmissionFactor"), shown("transmissionTexture").object(&TEXTURE_INFO)],
);
static VISIBILITY: Object = object("KHR_node_visibility", &[shown("visible")]);
// A thickness is for renderers that do not trace rays through the body.
static VOLUME: Object = object(
    "KHR_materials_volume",
    &[
        shown("attenuationColor"),
        shown("attenuationDistance"),
        shown("thicknessFactor"),
        ignored("thicknessTexture"),
    ],
);

/// Whether the list of numbers is there with another number than `default`.
fn differs(extension: &Value, name: &str, default: f64) -> bool {
    let numbers = extension.get(name).and_then(Value::as_array);
    numbers.is_some_and(|numbers| numbers.iter().any(|n| n.as_f64() != Some(default)))
}

/// Whether the texture that has this source has no other.
fn replaces_no_source(_: &Value, texture: &Site<'_>) -> bool {
    !texture.owner.contains_key("source")
}

/// Whether the primitive has no positions but the compressed ones.
fn has_no_other_positions(_: &Value, primitive: &Site<'_>) -> bool {
    let attributes = primitive.owner.get("attributes");
    let position = attributes.and_then(|a| primitive.element("/accessors", a.get("POSITION")?));
    position.is_none_or(|accessor| accessor.get("bufferView").is_none() && accessor.get("sparse").is_none())
}

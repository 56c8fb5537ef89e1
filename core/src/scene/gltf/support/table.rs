//! What is supported: the properties of glTF 2.0's JSON schema and the extensions of Khronos' registry, one line each.
//!
//! A property that is not [`shown`] is not read: the rest of the import never sees it.

use serde_json::Value;

use super::extensions::{IMAGE_BASED_LIGHT, LIGHT};
use super::{List, Object, Site, ignored, not_shown, object, present, shown};

/// The lists of the document's root whose elements other elements refer to by their index.
pub(super) static LISTS: [&List; 15] = [
    &ACCESSORS,
    &ANIMATIONS,
    &BUFFERS,
    &BUFFER_VIEWS,
    &CAMERAS,
    &IMAGES,
    &LIGHTS,
    &MATERIALS,
    &MESHES,
    &NODES,
    &SAMPLERS,
    &SCENES,
    &SKINS,
    &TEXTURES,
    &IMAGE_BASED_LIGHTS,
];

pub(super) static ACCESSORS: List =
    List::new("/accessors", &ACCESSOR, r#"{"componentType":5126,"type":"SCALAR","count":0}"#);
static ANIMATIONS: List = List::new("/animations", &ANIMATION, r#"{"channels":[],"samplers":[]}"#);
pub(super) static BUFFERS: List = List::new("/buffers", &BUFFER, r#"{"byteLength":0}"#);
pub(super) static BUFFER_VIEWS: List =
    List::new("/bufferViews", &BUFFER_VIEW, r#"{"buffer":0,"byteLength":0}"#);
static CAMERAS: List = List::new("/cameras", &CAMERA, r#"{"type":"perspective"}"#);
pub(super) static IMAGES: List = List::new("/images", &IMAGE, "{}");
pub(super) static IMAGE_BASED_LIGHTS: List =
    List::new("/extensions/EXT_lights_image_based/lights", &IMAGE_BASED_LIGHT, "{}");
pub(super) static LIGHTS: List =
    List::new("/extensions/KHR_lights_punctual/lights", &LIGHT, r#"{"type":"point"}"#);
pub(super) static MATERIALS: List = List::new("/materials", &MATERIAL, "{}");
static MESHES: List = List::new("/meshes", &MESH, r#"{"primitives":[]}"#);
pub(super) static NODES: List = List::new("/nodes", &NODE, "{}");
static SAMPLERS: List = List::new("/samplers", &SAMPLER, "{}");
pub(super) static SCENES: List = List::new("/scenes", &SCENE, r#"{"nodes":[]}"#);
static SKINS: List = List::new("/skins", &SKIN, r#"{"joints":[]}"#);
static TEXTURES: List = List::new("/textures", &TEXTURE, "{}");

/// The objects of the core specification.
#[cfg(test)]
pub(super) static OBJECTS: [&Object; 30] = [
    &ROOT,
    &ACCESSOR,
    &SPARSE,
    &SPARSE_INDICES,
    &SPARSE_VALUES,
    &ANIMATION,
    &ANIMATION_CHANNEL,
    &ANIMATION_TARGET,
    &ANIMATION_SAMPLER,
    &ASSET,
    &BUFFER,
    &BUFFER_VIEW,
    &CAMERA,
    &ORTHOGRAPHIC,
    &PERSPECTIVE,
    &IMAGE,
    &MATERIAL,
    &PBR_METALLIC_ROUGHNESS,
    &NORMAL_TEXTURE_INFO,
    &OCCLUSION_TEXTURE_INFO,
    &TEXTURE_INFO,
    &MESH,
    &PRIMITIVE,
    &ATTRIBUTES,
    &TARGET,
    &NODE,
    &SAMPLER,
    &SCENE,
    &SKIN,
    &TEXTURE,
];

pub(super) static ROOT: Object = object(
    "glTF",
    &[
        shown("accessors").list(),
        not_shown("animations", moves).elements(&ANIMATIONS),
        shown("asset").object(&ASSET),
        shown("bufferViews").list(),
        shown("buffers").list(),
        shown("cameras").list(),
        shown("extensionsRequired"),
        shown("extensionsUsed"),
        shown("images").list(),
        shown("materials").list(),
        shown("meshes").list(),
        shown("nodes").list(),
        shown("samplers").list(),
        shown("scene"),
        shown("scenes").list(),
        shown("skins").list(),
        shown("textures").list(),
    ],
);

static ACCESSOR: Object = object(
    "accessor",
    &[
        shown("bufferView").index(&BUFFER_VIEWS),
        shown("byteOffset"),
        shown("componentType"),
        shown("count"),
        shown("max"),
        shown("min"),
        ignored("name"),
        shown("normalized"),
        shown("sparse").object(&SPARSE),
        shown("type"),
    ],
);
static SPARSE: Object = object(
    "accessor.sparse",
    &[shown("count"), shown("indices").object(&SPARSE_INDICES), shown("values").object(&SPARSE_VALUES)],
);
static SPARSE_INDICES: Object = object(
    "accessor.sparse.indices",
    &[shown("bufferView").index(&BUFFER_VIEWS), shown("byteOffset"), shown("componentType")],
);
static SPARSE_VALUES: Object =
    object("accessor.sparse.values", &[shown("bufferView").index(&BUFFER_VIEWS), shown("byteOffset")]);

static ANIMATION: Object = object(
    "animation",
    &[
        shown("channels").objects(&ANIMATION_CHANNEL),
        ignored("name"),
        shown("samplers").objects(&ANIMATION_SAMPLER),
    ],
);
static ANIMATION_CHANNEL: Object =
    object("animation.channel", &[shown("sampler"), shown("target").object(&ANIMATION_TARGET)]);
static ANIMATION_TARGET: Object = object("animation.channel.target", &[shown("node"), shown("path")]);
static ANIMATION_SAMPLER: Object = object(
    "animation.sampler",
    &[shown("input").index(&ACCESSORS), shown("interpolation"), shown("output").index(&ACCESSORS)],
);

static ASSET: Object =
    object("asset", &[ignored("copyright"), ignored("generator"), shown("minVersion"), shown("version")]);

static BUFFER: Object = object("buffer", &[shown("byteLength"), ignored("name"), shown("uri")]);
// Targets are for the buffers of rasterisers.
static BUFFER_VIEW: Object = object(
    "bufferView",
    &[
        shown("buffer").index(&BUFFERS),
        shown("byteLength"),
        shown("byteOffset"),
        shown("byteStride"),
        ignored("name"),
        ignored("target"),
    ],
);

// The frame has its own aspect ratio, and rays have no depth range.
static CAMERA: Object = object(
    "camera",
    &[
        shown("name"),
        shown("orthographic").object(&ORTHOGRAPHIC),
        shown("perspective").object(&PERSPECTIVE),
        shown("type"),
    ],
);
static ORTHOGRAPHIC: Object = object(
    "camera.orthographic",
    &[
        ignored("xmag").demanded("1"),
        shown("ymag"),
        ignored("zfar").demanded("1"),
        ignored("znear").demanded("1"),
    ],
);
static PERSPECTIVE: Object = object(
    "camera.perspective",
    &[ignored("aspectRatio"), shown("yfov"), ignored("zfar"), ignored("znear").demanded("1")],
);

// Pictures say themselves of what type they are.
static IMAGE: Object = object(
    "image",
    &[shown("bufferView").index(&BUFFER_VIEWS), ignored("mimeType"), ignored("name"), shown("uri")],
);

static MATERIAL: Object = object(
    "material",
    &[
        shown("alphaCutoff"),
        shown("alphaMode"),
        shown("doubleSided"),
        shown("emissiveFactor"),
        shown("emissiveTexture").object(&TEXTURE_INFO),
        shown("extras"),
        shown("name"),
        shown("normalTexture").object(&NORMAL_TEXTURE_INFO),
        shown("occlusionTexture").object(&OCCLUSION_TEXTURE_INFO),
        shown("pbrMetallicRoughness").object(&PBR_METALLIC_ROUGHNESS),
    ],
);
static PBR_METALLIC_ROUGHNESS: Object = object(
    "material.pbrMetallicRoughness",
    &[
        shown("baseColorFactor"),
        shown("baseColorTexture").object(&TEXTURE_INFO),
        shown("metallicFactor"),
        shown("metallicRoughnessTexture").object(&TEXTURE_INFO),
        shown("roughnessFactor"),
    ],
);
pub(super) static NORMAL_TEXTURE_INFO: Object = object(
    "material.normalTextureInfo",
    &[shown("index").index(&TEXTURES), shown("scale"), shown("texCoord")],
);
static OCCLUSION_TEXTURE_INFO: Object = object(
    "material.occlusionTextureInfo",
    &[shown("index").index(&TEXTURES), shown("strength"), shown("texCoord")],
);
pub(super) static TEXTURE_INFO: Object =
    object("textureInfo", &[shown("index").index(&TEXTURES), shown("texCoord")]);

static MESH: Object =
    object("mesh", &[shown("name"), shown("primitives").objects(&PRIMITIVE), shown("weights")]);
static PRIMITIVE: Object = object(
    "mesh.primitive",
    &[
        shown("attributes").object(&ATTRIBUTES),
        shown("indices").index(&ACCESSORS),
        shown("material").index(&MATERIALS),
        shown("mode"),
        shown("targets").objects(&TARGET),
    ],
);
/// The attributes of a primitive; `n` stands for any number.
static ATTRIBUTES: Object = object(
    "mesh.primitive.attributes",
    &[
        shown("COLOR_0").index(&ACCESSORS),
        ignored("COLOR_n"),
        shown("JOINTS_n").index(&ACCESSORS),
        shown("NORMAL").index(&ACCESSORS),
        shown("POSITION").index(&ACCESSORS),
        shown("TANGENT").index(&ACCESSORS),
        shown("TEXCOORD_n").index(&ACCESSORS),
        shown("WEIGHTS_n").index(&ACCESSORS),
    ],
);

/// The displacements of a morph target.
static TARGET: Object = object(
    "mesh.primitive.target",
    &[
        not_shown("COLOR_n", present),
        shown("NORMAL").index(&ACCESSORS),
        shown("POSITION").index(&ACCESSORS),
        shown("TANGENT").index(&ACCESSORS),
        not_shown("TEXCOORD_n", present),
    ],
);

static NODE: Object = object(
    "node",
    &[
        shown("camera").index(&CAMERAS),
        shown("children").indices(&NODES),
        shown("matrix"),
        shown("mesh").index(&MESHES),
        shown("name"),
        shown("rotation"),
        shown("scale"),
        shown("skin").index(&SKINS),
        shown("translation"),
        shown("weights"),
    ],
);

// Textures are averaged over the footprint of a ray's cone, whatever the filter says.
static SAMPLER: Object = object(
    "sampler",
    &[shown("magFilter"), ignored("minFilter"), ignored("name"), shown("wrapS"), shown("wrapT")],
);

static SCENE: Object =
    object("scene", &[ignored("name"), shown("nodes").indices(&NODES).demanded("[]"), shown("extras")]);

// The skeleton's root is for editors.
static SKIN: Object = object(
    "skin",
    &[
        shown("inverseBindMatrices").index(&ACCESSORS),
        shown("joints").indices(&NODES),
        ignored("name"),
        ignored("skeleton"),
    ],
);

static TEXTURE: Object =
    object("texture", &[ignored("name"), shown("sampler").index(&SAMPLERS), shown("source").index(&IMAGES)]);

/// Whether a channel of the animation has something to move.
fn moves(animation: &Value, _: &Site<'_>) -> bool {
    let channels = animation.get("channels").and_then(Value::as_array);
    let moves = |channel: &Value| {
        let target = channel.get("target");
        target.is_some_and(|target| target.get("node").is_some() || target.get("extensions").is_some())
    };
    channels.is_some_and(|channels| channels.iter().any(moves))
}

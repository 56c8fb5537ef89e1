// What the shaders know of an object: its material in glTF's terms.

struct Object {
    base_color: vec3f,
    alpha: f32,
    emission: vec3f,
    alpha_cutoff: f32,
    metallic: f32,
    roughness: f32,
    transmission: f32,
    ior: f32,
    // Shares of local, mirrored and refracted light where OBJECT_WEIGHTS is set.
    weights: vec3f,
    flags: u32,
    // Places in the atlas.
    base_color_texture: vec3u,
    padding0: u32,
    metallic_roughness_texture: vec3u,
    padding1: u32,
    emissive_texture: vec3u,
    padding2: u32,
}

const OBJECT_UNLIT: u32 = 1u;
const OBJECT_THIN: u32 = 2u;
const OBJECT_WEIGHTS: u32 = 4u;
// Neither emits, mirrors, shines nor lets light through: the colour is all there is to read.
const OBJECT_MATTE: u32 = 8u;

var<storage, read> objects: array<Object>;

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
    base_color_texture: vec4u,
    metallic_roughness_texture: vec4u,
    emissive_texture: vec4u,
}

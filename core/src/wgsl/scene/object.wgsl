// An object's material as shaders read it, with glTF's parameters.

struct Object {
    base_color: vec3f,
    alpha: f32,
    emission: vec3f,
    alpha_cutoff: f32,
    metallic: f32,
    roughness: f32,
    transmission: f32,
    ior: f32,
    // Weights of diffuse, reflected and refracted light if OBJECT_WEIGHTS is set.
    weights: vec3f,
    flags: u32,
    // Places of the textures in the atlas.
    base_color_texture: vec4u,
    metallic_roughness_texture: vec4u,
    emissive_texture: vec4u,
}

// Reads an object; compilers drop the reads of unused fields.
fn object_at(object: u32) -> Object {
    let base = object_part(object, 0u);
    let emission = object_part(object, 1u);
    let surface = bitcast<vec4f>(object_part(object, 2u));
    let weights = object_part(object, 3u);
    return Object(
        bitcast<vec3f>(base.xyz), bitcast<f32>(base.w),
        bitcast<vec3f>(emission.xyz), bitcast<f32>(emission.w),
        surface.x, surface.y, surface.z, surface.w,
        bitcast<vec3f>(weights.xyz), weights.w,
        object_part(object, 4u), object_part(object, 5u), object_part(object, 6u),
    );
}

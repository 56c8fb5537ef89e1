// Reflection of a constant environment by surfaces that are not matte.

fn environment_kind(m: Material) -> u32 {
    return 0u;
}

fn environment_reflected(m: Material, diffuse: vec3f, normal: vec3f, view: vec3f) -> vec3f {
    return frame.ambient * (diffuse + material_rough_metal(m));
}

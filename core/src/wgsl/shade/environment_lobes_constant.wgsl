// Reflection of a constant environment by surfaces that are not matte.

fn environment_kind(m: Material) -> u32 {
    return 0u;
}

// Share of ambient light that the specular lobe of the dielectric part leaves to diffuse lobes.
fn environment_passed(m: Material, cosine: f32) -> vec3f {
    return vec3f(1.0);
}

fn environment_reflected(m: Material, diffuse: vec3f, normal: vec3f, view: vec3f) -> vec3f {
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let sheen = material_coat_passes(m, cosine) * material_sheen_albedo(m, cosine);
    return frame.ambient * (diffuse + material_rough_metal(m, cosine) * material_sheen_passes(m, cosine) + sheen);
}

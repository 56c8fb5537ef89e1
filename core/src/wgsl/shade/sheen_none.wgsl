// For scenes without sheen.

fn material_has_sheen(m: Material) -> bool {
    return false;
}

fn material_sheen_albedo(m: Material, cosine: f32) -> vec3f {
    return vec3f(0.0);
}

// Share of light that the sheen leaves for what is below it.
fn material_sheen_passes(m: Material, cosine: f32) -> f32 {
    return 1.0;
}

fn material_sheen_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return vec3f(0.0);
}

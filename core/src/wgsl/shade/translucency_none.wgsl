// For scenes without diffuse transmission.

fn translucency_reflected(m: Material) -> f32 {
    return 1.0;
}

fn translucency_albedo(m: Material, cosine: f32, inside: bool) -> vec3f {
    return vec3f(0.0);
}

fn translucency_local(m: Material, position: vec3f, normal: vec3f, view: vec3f, inside: bool, shadow: u32) -> vec3f {
    return vec3f(0.0);
}

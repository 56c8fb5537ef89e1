// For scenes without diffuse transmission or without punctual lights.

fn translucency_lit(albedo: vec3f, position: vec3f, normal: vec3f, shadow: u32) -> vec3f {
    return vec3f(0.0);
}

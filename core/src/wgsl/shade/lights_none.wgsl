// For scenes without punctual lights: no direct light.

fn lights_reflected(m: Material, diffuse: vec3f, position: vec3f, normal: vec3f, view: vec3f, shadow: u32) -> vec3f {
    return vec3f(0.0);
}

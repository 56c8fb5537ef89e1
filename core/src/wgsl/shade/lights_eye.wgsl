// For previews: light from the eye, which reaches every visible point.

fn lights_reflected(m: Material, diffuse: vec3f, position: vec3f, normal: vec3f, view: vec3f, shadow: u32) -> vec3f {
    return diffuse * (0.7 * max(dot(normal, view), 0.0));
}

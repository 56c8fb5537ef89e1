// A constant environment.

fn environment_radiance(direction: vec3f) -> vec3f {
    return frame.background;
}

fn environment_missed(kind: u32, direction: vec3f) -> vec3f {
    return frame.background;
}

fn environment_ambient(normal: vec3f) -> vec3f {
    return frame.ambient;
}

fn environment_cut_off(kind: u32, direction: vec3f) -> vec3f {
    return frame.fallback_radiance;
}

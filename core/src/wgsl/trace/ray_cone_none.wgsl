// For frames without mip mapping: no ray cones are traced.

fn cone_arrived(ray: Ray, t: f32) -> vec2f {
    return vec2f(0.0);
}

fn cone_footprint(width: f32, direction: vec3f, face: vec3f, corners: array<vec3f, 3>, texcoords: array<vec2f, 3>) -> vec3f {
    return vec3f(0.0);
}

fn cone_attribute(s: Surface) -> vec3f {
    return vec3f(0.0);
}

fn cone_bent(s: Surface, kept: f32, turned: f32) -> vec2f {
    return vec2f(0.0);
}

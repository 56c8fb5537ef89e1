// For scenes without textures.

fn texture_color(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    return vec4f(1.0);
}

fn texture_data(place: vec4u, texcoord: vec2f, footprint: vec3f) -> vec4f {
    return vec4f(1.0);
}

fn texture_alpha(place: vec4u, texcoord: vec2f) -> f32 {
    return 1.0;
}

fn texture_fold(object: u32, texcoord: vec2f) -> vec2f {
    return vec2f(0.0);
}

fn texture_seam_matters(object: u32) -> bool {
    return false;
}

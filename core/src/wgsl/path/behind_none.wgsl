// For scenes without diffuse transmission.

struct Behind {
    nothing: u32,
}

fn behind_of(m: Material, passed: vec3f) -> Behind {
    return Behind(0u);
}

fn behind_reaches(s: Surface, direction: vec3f) -> bool {
    return false;
}

fn behind_response(behind: Behind, s: Surface, direction: vec3f) -> vec4f {
    return vec4f(0.0);
}

fn behind_chance(behind: Behind) -> f32 {
    return 0.0;
}

fn behind_albedo(behind: Behind) -> vec3f {
    return vec3f(0.0);
}

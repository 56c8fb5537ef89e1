// The diffuse lobe of translucent surfaces on the side away from the viewer.

struct Behind {
    albedo: vec3f,
    // Largest channel.
    chance: f32,
}

// `passed` is what layers above and the specular lobe leave.
fn behind_of(m: Material, passed: vec3f) -> Behind {
    let share = (1.0 - m.metallic) * (1.0 - m.transmission) * m.translucency.share;
    let albedo = passed * share * m.translucency.color;
    return Behind(albedo, max_component(albedo));
}

fn behind_reaches(s: Surface, direction: vec3f) -> bool {
    return dot(s.normal, direction) < 0.0 && dot(s.face, direction) < 0.0 && translucency_is(s.object);
}

// The lobe times the cosine, and the density with which it is drawn.
fn behind_response(behind: Behind, s: Surface, direction: vec3f) -> vec4f {
    let cosine = max(-dot(s.normal, direction), 0.0) / PI;
    return vec4f(behind.albedo, behind.chance) * cosine;
}

fn behind_chance(behind: Behind) -> f32 {
    return behind.chance;
}

fn behind_albedo(behind: Behind) -> vec3f {
    return behind.albedo;
}

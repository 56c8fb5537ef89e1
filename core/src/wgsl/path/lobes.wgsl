// The lobes that a path may continue by; each is chosen with a probability proportional to its largest channel.

struct Lobes {
    diffuse: vec3f,
    mirror: vec3f,
    refraction: vec3f,
    // Largest channel of each lobe.
    chances: vec3f,
    // Sum of the largest channels.
    sum: f32,
    // Cosine of the angle to the normal on the viewer's side and, for refraction, on the other.
    cosine: f32,
    beyond: f32,
}

// The lobes at a surface; `direction` is the unit direction of the incident ray.
fn lobes_at(s: Surface, m: Material, direction: vec3f) -> Lobes {
    var lobes: Lobes;
    lobes.cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    lobes.diffuse = material_albedo(m, lobes.cosine, s.inside);
    if HAS_REFLECTION {
        lobes.mirror = material_mirror(m, lobes.cosine, s.inside);
    }
    if HAS_REFRACTION {
        lobes.refraction = material_refraction(m, lobes.cosine, s.inside);
        lobes.beyond = fresnel_transmitted(lobes.cosine, material_ratio(m, s.inside));
        if lobes.beyond <= 0.0 && !material_is(m, OBJECT_THIN) {
            lobes.refraction = vec3f(0.0);
        }
    }
    lobes.chances = vec3f(max_component(lobes.diffuse), max_component(lobes.mirror), max_component(lobes.refraction));
    lobes.sum = lobes.chances.x + lobes.chances.y + lobes.chances.z;
    return lobes;
}

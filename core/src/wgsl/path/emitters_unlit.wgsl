// For frames lit by punctual lights only: emitters are visible directly and by reflection and refraction, but
// illuminate nothing.

fn emitters_weight(density: f32, s: Surface, direction: vec3f) -> f32 {
    return select(0.0, 1.0, density == 0.0);
}

fn emitters_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    return vec3f(0.0);
}

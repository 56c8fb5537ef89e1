// Without next-event estimation: emitters contribute where a path hits them, or the scene has none.

fn emitters_weight(density: f32, s: Surface, direction: vec3f) -> f32 {
    return 1.0;
}

fn emitters_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    return vec3f(0.0);
}

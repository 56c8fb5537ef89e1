// Without next-event estimation: emitters contribute where a path hits them, or the scene has none.

fn emitters_weight(density: f32, s: Surface, direction: vec3f) -> f32 {
    return 1.0;
}

fn emitters_irradiance(s: Surface, chance_of_diffuse: f32, pixel: vec2u, dimension: u32) -> vec3f {
    return vec3f(0.0);
}

// Without next-event estimation of the environment: it contributes where a path leaves the scene.

fn environment_weight(density: f32, direction: vec3f) -> f32 {
    return 1.0;
}

fn environment_irradiance(s: Surface, chance_of_diffuse: f32, pixel: vec2u, dimension: u32) -> vec3f {
    return vec3f(0.0);
}

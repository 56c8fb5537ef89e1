// Without next-event estimation of the environment: it contributes where a path leaves the scene.

fn environment_weight(density: f32, direction: vec3f) -> f32 {
    return 1.0;
}

fn environment_light(s: Surface, lobes: Lobes, pixel: vec2u, dimension: u32) -> vec3f {
    return vec3f(0.0);
}

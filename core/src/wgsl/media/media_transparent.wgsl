// For scenes in which no medium absorbs light.

fn media_transmittance(object: u32, distance: f32) -> vec3f {
    return vec3f(1.0);
}

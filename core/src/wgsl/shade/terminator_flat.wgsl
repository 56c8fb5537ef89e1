// Share of a light that arrives at surfaces that are shaded by the normals of their faces.

fn shadow_arriving(s: Surface, light: u32, origin: vec3f, arrival: Arrival) -> f32 {
    if dot(s.face, arrival.direction) <= 0.0 {
        return 0.0;
    }
    let reach = lights_reach(light, arrival.distance);
    return shadow_along(Ray(origin, reach, arrival.direction, s.primitive, 0.0, vec2f(0.0)));
}

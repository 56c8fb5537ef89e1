// Direct light that passes through a translucent surface from behind.

fn translucency_lit(albedo: vec3f, position: vec3f, normal: vec3f, shadow: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < lights_count(); i += 1u) {
        let arrival = lights_arrival(i, position);
        let share = select(0.0, max(-dot(normal, arrival.direction), 0.0), (shadow & (1u << i)) == 0u);
        sum += share * arrival.irradiance;
    }
    return albedo * (1.0 / PI) * sum;
}

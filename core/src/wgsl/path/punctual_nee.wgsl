// Irradiance from punctual lights, with a shadow ray for each.

fn punctual_irradiance(s: Surface) -> vec3f {
    let shadow = shadow_bits(s);
    var sum = vec3f(0.0);
    for (var i = 0u; i < lights_count(); i += 1u) {
        let share = shadow_share(shadow, i);
        if share > 0.0 {
            let arrival = lights_arrival(i, s.position);
            sum += share * arrival.irradiance * max(dot(s.normal, arrival.direction), 0.0);
        }
    }
    return sum;
}

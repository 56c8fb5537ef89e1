// Light of punctual lights, with a shadow ray for each.

fn punctual_light(s: Surface, lobes: Lobes) -> vec3f {
    let shadow = shadow_bits(s);
    var sum = vec3f(0.0);
    for (var i = 0u; i < lights_count(); i += 1u) {
        let share = shadow_share(shadow, i);
        if share > 0.0 {
            let arrival = lights_arrival(i, s.position);
            sum += share * arrival.irradiance * response_to(s, lobes, arrival.direction).value;
        }
    }
    return sum;
}

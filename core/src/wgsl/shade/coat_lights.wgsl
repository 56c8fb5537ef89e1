// Direct light that coats with normals of their own reflect.

fn coat_lit(m: Material, position: vec3f, view: vec3f, shadow: u32) -> vec3f {
    let normal = m.coat_normal.normal;
    var sum = vec3f(0.0);
    for (var i = 0u; i < lights_count(); i += 1u) {
        let arrival = lights_arrival(i, position);
        let cosine = dot(normal, arrival.direction);
        if (shadow & (1u << i)) == 0u && cosine > 0.0 {
            sum += arrival.irradiance * cosine * material_coat_lobe(m, normal, view, arrival.direction);
        }
    }
    return sum;
}

// Point, spot and directional lights (KHR_lights_punctual).

struct Light {
    position: vec3f,
    kind: u32,
    intensity: vec3f,
    radius: f32,
    // Unit vector in which the light travels along the axis.
    direction: vec3f,
    // 1 / range^2, 0 without a range.
    inverse_range2: f32,
    // Cosine c of the angle to the axis gives the cone factor (c x scale + offset)^2, clamped to [0, 1].
    cone_scale: f32,
    cone_offset: f32,
    // Limit of the falloff factor on the intensity.
    limit: f32,
    padding: f32,
}

struct Lights {
    list: array<Light, 32>,
    count: u32,
}

var<uniform> lights: Lights;

fn lights_count() -> u32 {
    if LIGHT_COUNT_KNOWN {
        return LIGHT_COUNT;
    }
    return lights.count;
}

struct Arrival {
    // Unit vector from the surface to the light.
    direction: vec3f,
    distance: f32,
    irradiance: vec3f,
}

fn lights_arrival(index: u32, position: vec3f) -> Arrival {
    let light = lights.list[index];
    if light.kind == LIGHT_DIRECTIONAL {
        return Arrival(-light.direction, FAR, frame.exposure * light.intensity);
    }
    let to_light = light.position - position;
    let distance2 = max(dot(to_light, to_light), 1.0e-30);
    let inverse = inverseSqrt(distance2);
    let distance = distance2 * inverse;
    let direction = to_light * inverse;
    if light.kind == LIGHT_CONSTANT {
        return Arrival(direction, distance, frame.exposure * light.intensity);
    }
    let range_share = min(distance2 * light.inverse_range2, 1.0);
    let window = 1.0 - range_share * range_share;
    let cone = clamp(-dot(direction, light.direction) * light.cone_scale + light.cone_offset, 0.0, 1.0);
    let falloff = min(window * cone * cone * inverse * inverse, light.limit);
    return Arrival(direction, distance, frame.exposure * light.intensity * falloff);
}

// Length of a shadow ray: it ends in front of a surface in which the light lies.
fn lights_reach(index: u32, distance: f32) -> f32 {
    return max(distance * 0.99999 - lights.list[index].radius, 0.0);
}

fn lights_reflected(m: Material, diffuse: vec3f, position: vec3f, normal: vec3f, view: vec3f, shadow: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < lights_count(); i += 1u) {
        if (shadow & (1u << i)) != 0u {
            continue;
        }
        let arrival = lights_arrival(i, position);
        let cosine = dot(normal, arrival.direction);
        if cosine > 0.0 {
            sum += arrival.irradiance * cosine * (diffuse * (1.0 / PI) + material_lobe(m, normal, view, arrival.direction));
        }
    }
    return sum;
}

// For scenes without punctual lights.

fn punctual_light(s: Surface, lobes: Lobes) -> vec3f {
    return vec3f(0.0);
}

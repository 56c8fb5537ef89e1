// For scenes without punctual lights: no irradiance.

fn punctual_irradiance(s: Surface) -> vec3f {
    return vec3f(0.0);
}

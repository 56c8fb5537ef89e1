// No tone curve.

fn tone_mapped(radiance: vec3f) -> vec3f {
    return radiance;
}

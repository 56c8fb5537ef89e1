// The mean of a pixel's path samples.

fn samples_mean(pixel: vec2u) -> vec3f {
    return samples_load(pixel) / f32(frame.paths.sample + 1u + frame.paths.merged);
}

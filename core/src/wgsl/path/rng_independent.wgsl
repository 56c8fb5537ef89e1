// Independent random numbers: a hash of pixel, sample and dimension.

fn rng_words(pixel: vec2u, dimension: u32) -> vec2u {
    return rng_pcg4d(vec4u(pixel, frame.paths.sample, dimension)).xy;
}

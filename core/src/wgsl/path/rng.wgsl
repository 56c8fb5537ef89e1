// Random numbers of paths: hashed words, whose upper 24 bits make a number in [0, 1).

const RNG_SEED_STEP: u32 = 0x9e3779b9u;
// Dimension of the pair that positions a sample in its pixel.
const RNG_PLACE_IN_PIXEL: u32 = 0u;

// The hash pcg4d (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3)).
fn rng_pcg4d(words: vec4u) -> vec4u {
    var v = rng_mix(words * 1664525u + 1013904223u);
    v ^= v >> vec4u(16u);
    return rng_mix(v);
}

fn rng_mix(words: vec4u) -> vec4u {
    var v = words;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// A pair in [0, 1) for the pixel's sample of this frame. Pairs of different dimensions are independent.
fn rng_pair(pixel: vec2u, dimension: u32) -> vec2f {
    let words = rng_words(pixel, dimension ^ (frame.seed * RNG_SEED_STEP));
    return vec2f(words >> vec2u(8u)) / 16777216.0;
}

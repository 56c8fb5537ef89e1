// The random numbers of paths: hashed words, 24 bits of which make a number in [0, 1).

const NUMBERS_SEED_STEP: u32 = 0x9e3779b9u;
// The pair that says where in its pixel a sample is.
const NUMBERS_PLACE_IN_PIXEL: u32 = 0u;

// Hash Functions for GPU Rendering (Jarzynski, Olano 2020): four words from four.
fn numbers_pcg4d(words: vec4u) -> vec4u {
    var v = numbers_mixed(words * 1664525u + 1013904223u);
    v ^= v >> vec4u(16u);
    return numbers_mixed(v);
}

fn numbers_mixed(words: vec4u) -> vec4u {
    var v = words;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// A pair in [0, 1) of this frame's sample of a pixel. Pairs of different dimensions are independent.
fn numbers_pair(pixel: vec2u, dimension: u32) -> vec2f {
    let words = numbers_words(pixel, dimension ^ (frame.seed * NUMBERS_SEED_STEP));
    return vec2f(words >> vec2u(8u)) / 16777216.0;
}

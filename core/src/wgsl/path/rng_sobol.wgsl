// Random numbers that stratify the samples of a pixel: the two-dimensional Sobol' sequence, scrambled and
// shuffled for each pair (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)).

fn rng_words(pixel: vec2u, dimension: u32) -> vec2u {
    let keys = rng_pcg4d(vec4u(pixel, 0u, dimension));
    let index = rng_owen(frame.paths.sample, keys.x);
    return vec2u(rng_owen(reverseBits(index), keys.y), rng_owen(rng_sobol(index), keys.z));
}

// The second Sobol' dimension; the first is the bit-reversed index. The bits are the coefficients of a polynomial
// over GF(2) that is shifted by 1, in log2 steps (Ahmed 2024, "An Implementation Algorithm of 2D Sobol Sequence
// Fast, Elegant, and Compact").
fn rng_sobol(index: u32) -> u32 {
    var word = index;
    word ^= word >> 16u;
    word ^= (word >> 8u) & 0x00ff00ffu;
    word ^= (word >> 4u) & 0x0f0f0f0fu;
    word ^= (word >> 2u) & 0x33333333u;
    word ^= (word >> 1u) & 0x55555555u;
    return reverseBits(word);
}

// Owen scrambling: flips each bit depending on the bits above it.
fn rng_owen(word: u32, key: u32) -> u32 {
    var x = reverseBits(word) + key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reverseBits(x);
}

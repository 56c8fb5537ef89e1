// The samples of a pixel are spread evenly: the Sobol' sequence of two dimensions, scrambled and shuffled for each pair
// (Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)).

fn numbers_words(pixel: vec2u, dimension: u32) -> vec2u {
    let keys = numbers_pcg4d(vec4u(pixel, 0u, dimension));
    let index = numbers_owen(frame.sample, keys.x);
    return vec2u(numbers_owen(reverseBits(index), keys.y), numbers_owen(numbers_sobol(index), keys.z));
}

// The second dimension; the first is the bits of the index in reverse.
fn numbers_sobol(index: u32) -> u32 {
    var rest = index;
    var direction = 0x80000000u;
    var word = 0u;
    while rest != 0u {
        word ^= select(0u, direction, (rest & 1u) != 0u);
        rest >>= 1u;
        direction ^= direction >> 1u;
    }
    return word;
}

// Owen's scrambling: every bit is flipped or not by what stands above it.
fn numbers_owen(word: u32, key: u32) -> u32 {
    var x = reverseBits(word) + key;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return reverseBits(x);
}

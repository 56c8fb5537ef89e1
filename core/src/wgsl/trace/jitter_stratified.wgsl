// Jitters samples within their cells (lecture, "Jittered sampling"), by a hash of cell and seed. The samples of
// each square of 4x4 cells form a scrambled (0,2)-net (Sobol; Kollig & Keller 2002, "Efficient Multidimensional
// Sampling"): each sixteenth of its width and of its height has exactly one sample, so that edges of any slope
// divide them evenly.

// The hash pcg3d (Jarzynski, Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3)).
fn jitter_hash(at: vec2u) -> vec2u {
    var v = vec3u(at, frame.seed) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    return v.xy;
}

fn jitter_in(stratum: vec2u) -> vec2f {
    let scramble = jitter_hash(stratum / 4u) >> vec2u(30u);
    let low = jitter_net(stratum & vec2u(3u)) ^ scramble;
    return vec2f((low << vec2u(22u)) | (jitter_hash(stratum) >> vec2u(10u))) / 16777216.0;
}

// The third and fourth binary digits of the net's only point with these first two digits.
fn jitter_net(high: vec2u) -> vec2u {
    let fourth = (high.x ^ high.y) & 1u;
    let third = ((high.x >> 1u) ^ (high.y >> 1u) ^ high.y) & 1u;
    return vec2u(2u * third + fourth, 2u * (third ^ fourth) + fourth);
}

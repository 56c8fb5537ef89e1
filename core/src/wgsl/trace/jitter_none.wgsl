// Sample positions without jitter: the centre of each stratum.

fn jitter_in(stratum: vec2u) -> vec2f {
    return vec2f(0.5);
}

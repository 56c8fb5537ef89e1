// Unit vectors in 32 bits: octahedral mapping to two 16-bit signed normalised integers (Cigolle et al. 2014).

fn octahedral_encode(n: vec3f) -> u32 {
    let l1 = abs(n.x) + abs(n.y) + abs(n.z);
    var p = n.xy / max(l1, 1.0e-30);
    if n.z < 0.0 {
        let folded = 1.0 - abs(p.yx);
        p = select(-folded, folded, p >= vec2f(0.0));
    }
    return pack2x16snorm(p);
}

// Decodes to a vector of length 0.57 to 1, not normalised.
fn octahedral_direction(packed: u32) -> vec3f {
    let p = unpack2x16snorm(packed);
    let z = 1.0 - abs(p.x) - abs(p.y);
    let fold = max(-z, 0.0);
    let xy = p + select(vec2f(fold), vec2f(-fold), p >= vec2f(0.0));
    return vec3f(xy, z);
}

fn octahedral_decode(packed: u32) -> vec3f {
    return normalize(octahedral_direction(packed));
}

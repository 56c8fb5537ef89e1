// For scenes without lights: no shadow rays are traced.

fn shadow_bits(s: Surface) -> u32 {
    return 0u;
}

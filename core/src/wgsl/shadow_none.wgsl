// No lights, no shadow rays.

fn shadow_bits(s: Surface) -> u32 {
    return 0u;
}

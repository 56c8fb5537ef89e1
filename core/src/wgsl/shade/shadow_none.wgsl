// For scenes without lights: no shadow rays are traced.

fn shadow_bits(s: Surface) -> u32 {
    return 0u;
}

// Share of a light that arrives.
fn shadow_share(bits: u32, light: u32) -> f32 {
    return select(0.0, 1.0, (bits & (1u << light)) == 0u);
}

fn shadow_add_dimmed(s: Surface, m: Material, view: vec3f, weight: vec3f, sum: ptr<function, vec3f>) {}

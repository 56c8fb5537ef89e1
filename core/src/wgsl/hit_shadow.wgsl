// Some surfaces let shadow rays pass.

fn hit_counts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    return !shadow || (shading_at(primitive).w & SURFACE_NO_SHADOW) == 0u;
}

// Hit filter for scenes with surfaces that let shadow rays pass, and without alpha masks.

fn hit_counts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    return !shadow || (shading_at(primitive).w & SURFACE_NO_SHADOW) == 0u;
}

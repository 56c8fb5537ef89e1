// Any-hit filter for scenes with surfaces that shadow rays ignore, but without alpha masks.

fn any_hit_accepts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    return !shadow || (shading_at(primitive).w & SURFACE_NO_SHADOW) == 0u;
}

// Any-hit filter for scenes in which every surface stops every ray.

fn any_hit_accepts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    return true;
}

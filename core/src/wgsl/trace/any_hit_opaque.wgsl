// Hit filter for scenes in which every surface stops every ray.

fn hit_counts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    return true;
}

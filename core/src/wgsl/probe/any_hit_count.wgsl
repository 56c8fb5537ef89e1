// Hit filter of the probe that counts the surfaces along a ray: no surface stops it.

var<private> hit_counted: u32;

fn hit_counts(primitive: u32, u: f32, v: f32, shadow: bool) -> bool {
    hit_counted += 1u;
    return false;
}

// For scenes without analytic spheres.

fn sphere_is(primitive: u32) -> bool {
    return false;
}

fn sphere_hit(ray: Ray, primitive: u32) -> f32 {
    return -1.0;
}

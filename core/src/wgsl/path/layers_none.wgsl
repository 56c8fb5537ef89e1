// For scenes in which every surface hides what is behind it.

fn layers_pass(path: ptr<function, Path>, s: Surface) -> bool {
    return false;
}

fn layers_passed() -> bool {
    return false;
}

// The first surface on the way to a point on an emitter.
fn layers_arrive(ray: Ray, emitter: u32) -> Hit {
    return bvh_traverse(ray, false);
}

// Share of the emitter's light that the surfaces on the way let through.
fn layers_through() -> f32 {
    return 1.0;
}

// Analytic spheres stand among the triangles: centre and radius, and SPHERE_MARK where a triangle cannot have it.

fn sphere_is(primitive: u32) -> bool {
    return bvh_mark(primitive) == SPHERE_MARK;
}

// The parameter of the nearest hit in front of the ray, negative without one. In units of the radius, where nothing that
// matters overflows. The discriminant is that of the part of the origin's offset that is perpendicular to the ray (Haines
// et al., Ray Tracing Gems, chapter 7); which of the two hits counts follows from the side of the sphere that the
// ray starts on, not from the sign of a small difference.
fn sphere_hit(ray: Ray, primitive: u32) -> f32 {
    let corners = bvh_corners(primitive);
    let radius = corners[1].x;
    let offset = (corners[0] - ray.origin) / radius;
    let a = dot(ray.direction, ray.direction);
    let middle = dot(offset, ray.direction) / a;
    let perpendicular = offset - middle * ray.direction;
    let discriminant = 1.0 - dot(perpendicular, perpendicular);
    let beyond = dot(offset, offset) - 1.0;
    if discriminant <= 0.0 || (beyond >= 0.0 && middle <= 0.0) {
        return -1.0;
    }
    let half_chord = sqrt(discriminant / a);
    let far = middle + half_chord;
    // Near the surface the difference cancels, the quotient of the roots' product does not.
    let near = select(middle - half_chord, beyond / (a * far), beyond < 1.0);
    let passed = HAS_PANES && radius * near <= ray.after;
    return radius * select(far, near, beyond >= 0.0 && !passed);
}

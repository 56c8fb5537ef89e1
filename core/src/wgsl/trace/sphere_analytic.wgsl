// Analytic spheres, stored among the triangles as centre and radius, with SPHERE_MARK where no triangle has such
// a number.

fn sphere_is(primitive: u32) -> bool {
    return bvh_mark(primitive) == SPHERE_MARK;
}

// Parameter of the nearest hit in front of the ray, negative if there is none. Computed in units of the radius to
// avoid overflow. The discriminant uses the component of the origin's offset perpendicular to the ray (Haines et
// al., Ray Tracing Gems, chapter 7). The side of the sphere that the ray starts on selects the hit, not the sign
// of a small difference.
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
    // Near the surface the difference cancels, but the root from the product of both roots does not.
    let near = select(middle - half_chord, beyond / (a * far), beyond < 1.0);
    let passed = HAS_PANES && radius * near <= ray.after;
    return radius * select(far, near, beyond >= 0.0 && !passed);
}

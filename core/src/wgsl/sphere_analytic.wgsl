// Analytic spheres stand among the triangles: centre and radius, and SPHERE_MARK where a triangle cannot have it.

fn sphere_is(primitive: u32) -> bool {
    return primitives[9u * primitive + 4u] == SPHERE_MARK;
}

// The parameter of the nearest hit in front of the ray, negative without one. The discriminant is that of the
// part of the origin's offset that is perpendicular to the ray (Haines et al., Ray Tracing Gems, chapter 7).
fn sphere_hit(ray: Ray, primitive: u32) -> f32 {
    let corners = bvh_corners(primitive);
    let center = corners[0];
    let radius = corners[1].x;
    let offset = center - ray.origin;
    let a = dot(ray.direction, ray.direction);
    let middle = dot(offset, ray.direction) / a;
    let perpendicular = offset - middle * ray.direction;
    let discriminant = radius * radius - dot(perpendicular, perpendicular);
    if discriminant <= 0.0 {
        return -1.0;
    }
    let half_chord = sqrt(discriminant / a);
    return select(middle + half_chord, middle - half_chord, middle - half_chord > 0.0);
}

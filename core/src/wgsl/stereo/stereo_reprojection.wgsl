// Visibility of a path's first surface, or of its image in a planar mirror, from the other eye.

struct StereoReprojection {
    pixel: vec2u,
    ray: Ray,
    // Bounce level: 1 for the primary ray.
    level: u32,
    stereo_reuse: StereoReuse,
}

// The hit of a ray with the primitive that it is known to hit first.
fn stereo_reproject_hit(ray: Ray, primitive: u32) -> Hit {
    if sphere_is(primitive) {
        return Hit(sphere_hit(ray, primitive), primitive, 0.0, 0.0);
    }
    let found = triangle_hit(triangle_shear(ray), bvh_corners(primitive), FAR);
    return Hit(found.t, primitive, found.u, found.v);
}

// Retraces the path through the primitives that it has hit (index + 1, 0 for none).
fn stereo_reproject_path(reprojection: ptr<function, StereoReprojection>, first: u32, second: u32) {
    var next = first;
    while next != 0u && (*reprojection).level < frame.depth {
        let ray = (*reprojection).ray;
        let direction = normalize(ray.direction);
        var s = surface_at(ray, stereo_reproject_hit(ray, next - 1u));
        let m = surface_material(&s, direction);
        let lobes = lobes_at(s, m, direction);
        if lobes_unlit(m) || lobes.sum <= 0.0 || !stereo_reuse_at(reprojection, s, m, lobes) {
            return;
        }
        (*reprojection).ray = lobes_specular(s, m, lobes, ray, direction, 0.0).ray;
        (*reprojection).level += 1u;
        next = second;
    }
}

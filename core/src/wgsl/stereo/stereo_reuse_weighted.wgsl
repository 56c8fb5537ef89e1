// Weighted reuse: a sample also counts in the other eye if that sees the same point on a diffuse surface. Weights
// in both pixels compensate for finding the point in two ways (balance heuristic, Veach & Guibas 1995): where one
// eye samples points with density 1 per pixel, the other does with density k, the ratio of the surface's size in
// the other's image to that in the one's.

struct StereoReuse {
    // Weight of the sample in its own pixel.
    own: f32,
    // Pixel of the other eye: index + 1, 0 for none.
    splat: u32,
    // Weight of the sample in the other eye's pixel, for each channel.
    other: vec3f,
    mirror: StereoReuseMirror,
}

// Points coincide up to this distance, relative to the distance from the eye.
const STEREO_REUSE_NEAR: f32 = 1.0e-3;

fn stereo_reuse_begin() -> StereoReuse {
    return StereoReuse(1.0, 0u, vec3f(0.0), stereo_reuse_mirror_none());
}

// What an eye sees: a surface point, or its image in a mirror.
struct StereoReuseImage {
    point: vec3f,
    face: vec3f,
}

// Tests a hit from the other eye; true for a mirror, whose image is tested next.
fn stereo_reuse_at(reprojection: ptr<function, StereoReprojection>, s: Surface, m: Material, lobes: Lobes) -> bool {
    if stereo_reuse_enters_mirror(reprojection, s, m, lobes) {
        return true;
    }
    if lobes.chances.x == lobes.sum {
        stereo_reuse_find(reprojection, s);
    }
    return false;
}

fn stereo_reuse_find(reprojection: ptr<function, StereoReprojection>, s: Surface) {
    let mirror = (*reprojection).stereo_reuse.mirror;
    let image = stereo_reuse_image(mirror, s);
    let own = eyes_of((*reprojection).pixel);
    let to = eyes_other(own);
    let here = dot(image.face, image.point - eyes_origin(own));
    let there = dot(image.face, image.point - eyes_origin(to));
    let splat = eyes_project(to, image.point);
    if !(here * there > 0.0) || splat == 0u {
        return;
    }
    let share = stereo_reuse_share(mirror, s, eyes_ray_to(to, image.point, 1.0 + STEREO_REUSE_NEAR));
    if share.x < 0.0 {
        return;
    }
    // k is there / here.
    (*reprojection).stereo_reuse.own = here / (here + there);
    (*reprojection).stereo_reuse.splat = splat;
    (*reprojection).stereo_reuse.other = there / (here + there) * share;
}

// Whether a ray to a surface point at parameter 1 has hit that point.
fn stereo_reuse_same_point(hit: Hit, s: Surface) -> bool {
    if hit.primitive == MISS || hit.primitive == s.primitive {
        return hit.primitive == s.primitive;
    }
    return (shading_at(hit.primitive).w & SURFACE_OBJECT) == s.object && abs(hit.t - 1.0) < STEREO_REUSE_NEAR;
}

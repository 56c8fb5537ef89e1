// Reuse for scenes without mirrors: the other eye is tested against first hits only.

struct StereoReuseMirror {
    there: bool,
}

fn stereo_reuse_mirror_none() -> StereoReuseMirror {
    return StereoReuseMirror(false);
}

fn stereo_reuse_enters_mirror(reprojection: ptr<function, StereoReprojection>, s: Surface, m: Material, lobes: Lobes) -> bool {
    return false;
}

fn stereo_reuse_image(mirror: StereoReuseMirror, s: Surface) -> StereoReuseImage {
    return StereoReuseImage(s.position, s.face);
}

// Weight of the light along the other eye's ray relative to that along this eye's path; negative if the ray does
// not reach the point.
fn stereo_reuse_share(mirror: StereoReuseMirror, s: Surface, ray: Ray) -> vec3f {
    inspect_ray(RAY_SHADOW);
    return vec3f(select(-1.0, 1.0, stereo_reuse_same_point(bvh_traverse(ray, false), s)));
}

// Reuse for scenes without mirrors: the other eye is tested against first hits alone.

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

// What the light that the other eye's ray finds counts for, compared to what this eye's path found; negative if the ray does
// not get there.
fn stereo_reuse_share(mirror: StereoReuseMirror, s: Surface, ray: Ray) -> vec3f {
    inspect_ray(RAY_SHADOW);
    return vec3f(select(-1.0, 1.0, stereo_reuse_same_point(bvh_traverse(ray, false), s)));
}

// Reuse for scenes with mirrors: the other eye is tested against first hits, and against hits behind a planar
// mirror by way of the same mirror.

// The first hit, if it is a purely specular planar mirror.
struct StereoReuseMirror {
    there: bool,
    object: u32,
    point: vec3f,
    face: vec3f,
    // Reflectance of the mirror for each channel.
    share: vec3f,
}

// Faces with at least this cosine between their normals are coplanar.
const STEREO_REUSE_PLANE: f32 = 0.999999;

fn stereo_reuse_mirror_none() -> StereoReuseMirror {
    return StereoReuseMirror(false, 0u, vec3f(0.0), vec3f(0.0), vec3f(0.0));
}

fn stereo_reuse_only_mirrors(s: Surface, m: Material, lobes: Lobes) -> bool {
    let only = lobes.chances.y > 0.0 && lobes.chances.y == lobes.sum && all(lobes_emission(m) == vec3f(0.0));
    return only && !sphere_is(s.primitive) && all(s.normal == s.face) && coat_mirrored(m, lobes.cosine) == 0.0;
}

fn stereo_reuse_enters_mirror(reprojection: ptr<function, StereoReprojection>, s: Surface, m: Material, lobes: Lobes) -> bool {
    let mirrors = (*reprojection).level == 1u && stereo_reuse_only_mirrors(s, m, lobes);
    if mirrors {
        (*reprojection).stereo_reuse.mirror = StereoReuseMirror(true, s.object, s.position, s.face, lobes.mirror);
    }
    return mirrors;
}

// The mirror image of a surface point behind the mirror's plane.
fn stereo_reuse_image(mirror: StereoReuseMirror, s: Surface) -> StereoReuseImage {
    if !mirror.there {
        return StereoReuseImage(s.position, s.face);
    }
    let behind = 2.0 * dot(s.position - mirror.point, mirror.face) * mirror.face;
    return StereoReuseImage(s.position - behind, reflect(s.face, mirror.face));
}

// Weight of the light along the other eye's ray relative to that along this eye's path; negative if the ray does
// not reach the point. A loop over mirror and surface, so that the traversal is inlined once.
fn stereo_reuse_share(mirror: StereoReuseMirror, s: Surface, to: Ray) -> vec3f {
    var ray = to;
    var share = vec3f(1.0);
    var ahead = mirror.there;
    loop {
        inspect_ray(RAY_SHADOW);
        let hit = bvh_traverse(ray, false);
        if !ahead {
            return select(vec3f(-1.0), share, stereo_reuse_same_point(hit, s));
        }
        if hit.primitive == MISS {
            break;
        }
        var z = surface_at(ray, hit);
        let direction = normalize(ray.direction);
        let m = surface_material(&z, direction);
        let lobes = lobes_at(z, m, direction);
        let apart = abs(dot(mirror.face, z.position - mirror.point));
        let coplanar = dot(z.face, mirror.face) > STEREO_REUSE_PLANE && apart < STEREO_REUSE_NEAR * length(z.position - to.origin);
        if !(z.object == mirror.object && coplanar && stereo_reuse_only_mirrors(z, m, lobes)) {
            break;
        }
        share = select(vec3f(0.0), lobes.mirror / mirror.share, mirror.share > vec3f(0.0));
        ray = surface_spawn(z, s.position - z.position, 1.0 + STEREO_REUSE_NEAR, vec2f(0.0));
        ahead = false;
    }
    return vec3f(-1.0);
}

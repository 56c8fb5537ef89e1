// Unweighted reuse: a sample counts fully in the other eye if that sees the point on a diffuse surface (Kim &
// Sung 2021, equations 1 to 5), and where a reflected ray meets the plane of the other eye's image (equation 6).
// The plane is at depth 1.

struct StereoReuse {
    // Weight of the sample in its own pixel.
    own: f32,
    // Pixel of the other eye: index + 1, 0 for none.
    splat: u32,
    // Weight of the sample in the other eye's pixel, for each channel.
    other: vec3f,
}

fn stereo_reuse_begin() -> StereoReuse {
    return StereoReuse(1.0, 0u, vec3f(1.0));
}

fn stereo_reuse_at(reprojection: ptr<function, StereoReprojection>, s: Surface, m: Material, lobes: Lobes) -> bool {
    if lobes.chances.x + lobes.chances.y > 0.0 {
        stereo_reuse_find(reprojection, s, lobes);
    }
    return false;
}

fn stereo_reuse_find(reprojection: ptr<function, StereoReprojection>, s: Surface, lobes: Lobes) {
    let to = eyes_other(eyes_of((*reprojection).pixel));
    var seen = s.position;
    var end = eyes_origin(to);
    if lobes.chances.y > 0.0 {
        let direction = reflect(normalize((*reprojection).ray.direction), s.normal);
        let distance = dot(frame.camera.forward, end + frame.camera.forward - s.position) / dot(frame.camera.forward, direction);
        if !(distance > 0.0 && distance < FAR) {
            return;
        }
        end = s.position + distance * direction;
        seen = end;
    }
    let splat = eyes_project(to, seen);
    if splat == 0u {
        return;
    }
    inspect_ray(RAY_SHADOW);
    if bvh_traverse(surface_spawn(s, end - s.position, 1.0, vec2f(0.0)), true).primitive == MISS {
        (*reprojection).stereo_reuse.splat = splat;
    }
}

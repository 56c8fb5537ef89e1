// Reuse for scenes without mirrors: the other eye is tested against first hits alone.

struct CrossingMirror {
    there: bool,
}

fn crossing_mirror_none() -> CrossingMirror {
    return CrossingMirror(false);
}

fn crossing_mirrors(look: ptr<function, Look>, s: Surface, m: Material, lobes: Lobes) -> bool {
    return false;
}

fn crossing_image(mirror: CrossingMirror, s: Surface) -> CrossingImage {
    return CrossingImage(s.position, s.face);
}

// What the light that the other eye's ray finds counts for, compared to what this eye's path found; negative if the ray does
// not get there.
fn crossing_share(mirror: CrossingMirror, s: Surface, ray: Ray) -> vec3f {
    inspect_ray(RAY_SHADOW);
    return vec3f(select(-1.0, 1.0, crossing_meets(bvh_traverse(ray, false), s)));
}

// The other eye looks at first hits, and at what the path has met behind a plane mirror: by the same mirror.

// The first hit, if it is a plane mirror and no more.
struct CrossingMirror {
    there: bool,
    object: u32,
    point: vec3f,
    face: vec3f,
    // Weight of the light that arrives by the mirror, for each channel.
    share: vec3f,
}

// Faces are of one plane whose normals have this cosine.
const CROSSING_PLANE: f32 = 0.999999;

fn crossing_mirror_none() -> CrossingMirror {
    return CrossingMirror(false, 0u, vec3f(0.0), vec3f(0.0), vec3f(0.0));
}

fn crossing_only_mirrors(s: Surface, m: Material, lobes: Lobes) -> bool {
    let only = lobes.chances.y > 0.0 && lobes.chances.y == lobes.sum && all(lobes_emission(m) == vec3f(0.0));
    return only && !sphere_is(s.primitive) && all(s.normal == s.face);
}

fn crossing_mirrors(look: ptr<function, Look>, s: Surface, m: Material, lobes: Lobes) -> bool {
    let mirrors = (*look).level == 1u && crossing_only_mirrors(s, m, lobes);
    if mirrors {
        (*look).crossing.mirror = CrossingMirror(true, s.object, s.position, s.face, lobes.mirror);
    }
    return mirrors;
}

// The mirror image of a surface point behind the mirror's plane.
fn crossing_image(mirror: CrossingMirror, s: Surface) -> CrossingImage {
    if !mirror.there {
        return CrossingImage(s.position, s.face);
    }
    let behind = 2.0 * dot(s.position - mirror.point, mirror.face) * mirror.face;
    return CrossingImage(s.position - behind, reflect(s.face, mirror.face));
}

// What the light that the other eye's ray finds counts for, compared to what this eye's path found; negative if the ray does
// not get there. A loop, so that there is one traversal: to the mirror, and on.
fn crossing_share(mirror: CrossingMirror, s: Surface, to: Ray) -> vec3f {
    var ray = to;
    var share = vec3f(1.0);
    var ahead = mirror.there;
    loop {
        inspect_ray(RAY_SHADOW);
        let hit = bvh_traverse(ray, false);
        if !ahead {
            return select(vec3f(-1.0), share, crossing_meets(hit, s));
        }
        if hit.primitive == MISS {
            break;
        }
        let z = surface_at(ray, hit);
        let m = material_at(z.object, z.texcoord, z.footprint, z.color);
        let lobes = lobes_at(z, m, normalize(ray.direction));
        let apart = abs(dot(mirror.face, z.position - mirror.point));
        let coplanar = dot(z.face, mirror.face) > CROSSING_PLANE && apart < CROSSING_NEAR * length(z.position - to.origin);
        if !(z.object == mirror.object && coplanar && crossing_only_mirrors(z, m, lobes)) {
            break;
        }
        share = select(vec3f(0.0), lobes.mirror / mirror.share, mirror.share > vec3f(0.0));
        ray = surface_spawn(z, s.position - z.position, 1.0 + CROSSING_NEAR, vec2f(0.0));
        ahead = false;
    }
    return vec3f(-1.0);
}

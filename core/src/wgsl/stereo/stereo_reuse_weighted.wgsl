// A sample of one eye is one of the other eye too, if that sees the same point of a diffuse surface. In its own pixel and in
// the other it counts for as much as makes up for finding the point in two ways (balance heuristic: Veach, Guibas 1995):
// where the one eye finds points with a density of 1 to a pixel, the other finds them with one of k, the size that the
// surface has in the other's picture over that in the one's.

struct Crossing {
    // Weight of the sample in its own pixel.
    own: f32,
    // Where it lands: the index of a pixel + 1, 0 for nowhere.
    landing: u32,
    // Weight of the sample in the other eye's pixel, for each channel.
    other: vec3f,
    mirror: CrossingMirror,
}

// Points coincide that are no farther apart, of the distance from the eye.
const CROSSING_NEAR: f32 = 1.0e-3;

fn crossing_begin() -> Crossing {
    return Crossing(1.0, 0u, vec3f(0.0), crossing_mirror_none());
}

// What an eye sees: a point of a surface, or its image in a mirror.
struct CrossingImage {
    point: vec3f,
    face: vec3f,
}

// Looks from the other eye at what the path has met; true where it is a mirror, to look at what is behind.
fn crossing_at(look: ptr<function, Look>, s: Surface, m: Material, lobes: Lobes) -> bool {
    if crossing_mirrors(look, s, m, lobes) {
        return true;
    }
    if lobes.chances.x == lobes.sum {
        crossing_find(look, s);
    }
    return false;
}

fn crossing_find(look: ptr<function, Look>, s: Surface) {
    let mirror = (*look).crossing.mirror;
    let image = crossing_image(mirror, s);
    let own = eyes_of((*look).pixel);
    let to = eyes_other(own);
    let here = dot(image.face, image.point - eyes_origin(own));
    let there = dot(image.face, image.point - eyes_origin(to));
    let landing = eyes_find(to, image.point);
    if !(here * there > 0.0) || landing == 0u {
        return;
    }
    let share = crossing_share(mirror, s, eyes_ray_to(to, image.point, 1.0 + CROSSING_NEAR));
    if share.x < 0.0 {
        return;
    }
    // k is there / here.
    (*look).crossing.own = here / (here + there);
    (*look).crossing.landing = landing;
    (*look).crossing.other = there / (here + there) * share;
}

// Has a ray to a point of a surface at 1 of its parameter met that point?
fn crossing_meets(hit: Hit, s: Surface) -> bool {
    if hit.primitive == MISS || hit.primitive == s.primitive {
        return hit.primitive == s.primitive;
    }
    return (shading_at(hit.primitive).w & SURFACE_OBJECT) == s.object && abs(hit.t - 1.0) < CROSSING_NEAR;
}

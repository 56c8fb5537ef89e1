// Partial coverage along paths: a path meets a surface with the probability that the surface covers, and goes
// straight on otherwise. Light from emitters is dimmed by the expectation.

// First dimension of the choices at partly covering surfaces, beyond those of all vertices.
const LAYERS_DIMENSION: u32 = 0x40000000u;

// Number of partly covering surfaces that the path has met.
var<private> layers_met: u32;
// Whether the path has gone straight on through one of them.
var<private> layers_straight: bool;
var<private> layers_share: f32;

// Continues the path straight through the surface by chance; false if it meets the surface.
fn layers_pass(path: ptr<function, Path>, s: Surface) -> bool {
    if (*path).level == 1u && (*path).ray.left == MISS {
        layers_met = 0u;
        layers_straight = false;
    }
    let covered = coverage_of(s.object, s.texcoord, s.footprint, s.alpha);
    if covered >= 1.0 || layers_met >= MAX_RAYS {
        return false;
    }
    let random = rng_pair((*path).pixel, LAYERS_DIMENSION + layers_met).x;
    layers_met += 1u;
    if random < covered {
        return false;
    }
    gbuffer_hit(path, s.t);
    (*path).ray = surface_pass(s, (*path).ray);
    layers_straight = true;
    return true;
}

fn layers_passed() -> bool {
    return layers_straight;
}

// The first surface that hides all behind it on the way to a point on an emitter, or the emitter.
fn layers_arrive(ray: Ray, emitter: u32) -> Hit {
    layers_share = 1.0;
    var onward = ray;
    var hit = bvh_traverse(onward, false);
    for (var i = 0u; i < MAX_RAYS && hit.primitive != MISS; i += 1u) {
        let s = surface_at(onward, hit);
        let covered = coverage_of(s.object, s.texcoord, s.footprint, s.alpha);
        if hit.primitive == emitter {
            layers_share *= covered;
            break;
        }
        if covered >= 1.0 {
            break;
        }
        layers_share *= 1.0 - covered;
        onward = Ray(ray.origin, ray.t_max, ray.direction, hit.primitive, hit.t, ray.cone);
        inspect_ray(RAY_SHADOW);
        hit = bvh_traverse(onward, false);
    }
    return hit;
}

// Share of the emitter's light that the surfaces on the way let through.
fn layers_through() -> f32 {
    return layers_share;
}

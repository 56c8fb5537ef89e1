// Specular reflection as an iterated chain of rays, up to the depth limit or the least weight. Rays that are cut
// off are taken to meet nothing where there is an environment map, else they have the fallback radiance.

struct PathState {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

var<private> scatter_pending: PathState;
var<private> scatter_is_pending: bool;

fn scatter_next(state: ptr<function, PathState>) -> bool {
    let next = scatter_is_pending;
    *state = scatter_pending;
    scatter_is_pending = false;
    return next;
}

// Continues with the reflected ray; `direction` is the unit direction of the incident ray.
fn scatter(s: Surface, m: Material, state: PathState, direction: vec3f) -> vec3f {
    let cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    let weight = state.weight * material_mirror(m, cosine, s.inside);
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest <= 0.0 {
        return vec3f(0.0);
    }
    let kind = RAY_REFLECTION | environment_kind(m);
    let reflected = normalize(reflect(direction, coat_reflecting(m, s.normal, cosine, s.inside)));
    if state.level >= frame.depth || largest < frame.min_weight {
        return weight * environment_cut_off(kind, reflected);
    }
    let ray = surface_spawn(s, reflected, FAR, cone_bent(s, 1.0, 2.0));
    scatter_pending = PathState(ray, weight, state.level + 1u, kind);
    scatter_is_pending = true;
    return vec3f(0.0);
}

// Specular reflection and refraction: a tree of rays, traversed with a stack of pending branches. Rays cut off by
// the depth limit, the least weight or the limit of rays are taken to meet nothing where there is an environment map, else
// they have the fallback radiance.

struct PathState {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

var<private> scatter_stack: array<PathState, SCATTER_STACK>;
var<private> scatter_stack_size: u32;
// Number of branches that were pushed for this sample.
var<private> scatter_count: u32;

fn scatter_next(state: ptr<function, PathState>) -> bool {
    if scatter_stack_size == 0u {
        scatter_count = 0u;
        return false;
    }
    scatter_stack_size -= 1u;
    *state = scatter_stack[scatter_stack_size];
    media_pop(scatter_stack_size);
    return true;
}

// Pushes a branch; returns radiance in its place if a limit cuts it off.
fn scatter_push(ray: Ray, weight: vec3f, level: u32, kind: u32) -> vec3f {
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest <= 0.0 {
        return vec3f(0.0);
    }
    // The primary ray counts among the MAX_RAYS rays of a sample.
    if level > frame.depth || largest < frame.min_weight || scatter_count + 1u >= MAX_RAYS {
        return weight * environment_cut_off(kind, ray.direction);
    }
    scatter_stack[scatter_stack_size] = PathState(ray, weight, level, kind);
    media_push(scatter_stack_size, kind & RAY_KIND);
    scatter_stack_size += 1u;
    scatter_count += 1u;
    return vec3f(0.0);
}

// Continues with both rays; `direction` is the unit direction of the incident ray.
fn scatter(s: Surface, m: Material, state: PathState, direction: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    let level = state.level + 1u;
    let cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    let transmitted = state.weight * material_refraction(m, cosine, s.inside);
    if max(transmitted.x, max(transmitted.y, transmitted.z)) > 0.0 {
        let ratio = material_ratio(m, s.inside);
        let beyond = fresnel_transmitted(cosine, ratio);
        if material_is(m, OBJECT_THIN) {
            sum += scatter_push(surface_pass(s, state.ray), transmitted, level, RAY_REFRACTION | environment_kind(m));
        } else if beyond > 0.0 {
            let refracted = fresnel_refracted(direction, s.normal, cosine, ratio, beyond);
            let cone = cone_bent(s, ratio, ratio * cosine - beyond);
            sum += scatter_push(surface_spawn(s, refracted, FAR, cone), transmitted, level, RAY_REFRACTION | environment_kind(m));
        }
    }
    let mirrored = state.weight * material_mirror(m, cosine, s.inside);
    if max(mirrored.x, max(mirrored.y, mirrored.z)) <= 0.0 {
        return sum;
    }
    let reflected = surface_spawn(s, normalize(reflect(direction, coat_reflecting(m, s.normal, cosine, s.inside))), FAR, cone_bent(s, 1.0, 2.0));
    return sum + scatter_push(reflected, mirrored, level, RAY_REFLECTION | environment_kind(m));
}

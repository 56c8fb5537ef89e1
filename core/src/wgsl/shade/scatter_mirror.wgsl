// Mirror reflection: one ray follows the other until the depth limit or the weight cut. What is cut off is
// replaced by the environment's truncated radiance.

struct Branch {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

var<private> bounce_pending: Branch;
var<private> bounce_is_pending: bool;

fn bounce_next(branch: ptr<function, Branch>) -> bool {
    let next = bounce_is_pending;
    *branch = bounce_pending;
    bounce_is_pending = false;
    return next;
}

// Sends the reflected ray on its way; `direction` is the unit direction of the ray that hit.
fn bounce_split(s: Surface, m: Material, branch: Branch, direction: vec3f) -> vec3f {
    let cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    let weight = branch.weight * material_mirror(m, cosine, s.inside);
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest <= 0.0 {
        return vec3f(0.0);
    }
    if branch.level >= frame.depth || largest < frame.min_weight {
        return weight * frame.truncated;
    }
    let ray = surface_spawn(s, normalize(reflect(direction, s.normal)), FAR, cone_bent(s, 1.0, 2.0));
    bounce_pending = Branch(ray, weight, branch.level + 1u, RAY_REFLECTION);
    bounce_is_pending = true;
    return vec3f(0.0);
}

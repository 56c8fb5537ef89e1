// Mirror reflection and refraction: a tree of rays, walked with a stack of the branches still to come. What the
// depth limit, the weight cut or the limit of rays leaves out is replaced by the environment's truncated radiance.

struct Branch {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

var<private> bounce_stack: array<Branch, BOUNCE_STACK>;
var<private> bounce_stacked: u32;
// Number of branches that were pushed for this sample.
var<private> bounce_kept: u32;

fn bounce_next(branch: ptr<function, Branch>) -> bool {
    if bounce_stacked == 0u {
        bounce_kept = 0u;
        return false;
    }
    bounce_stacked -= 1u;
    *branch = bounce_stack[bounce_stacked];
    return true;
}

// Pushes a branch, or returns the radiance that stands for it where a limit cuts it off.
fn bounce_push(ray: Ray, weight: vec3f, level: u32, kind: u32) -> vec3f {
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest <= 0.0 {
        return vec3f(0.0);
    }
    // The primary ray counts among the MAX_RAYS rays of a sample.
    if level > frame.depth || largest < frame.min_weight || bounce_kept + 1u >= MAX_RAYS {
        return weight * frame.truncated;
    }
    bounce_stack[bounce_stacked] = Branch(ray, weight, level, kind);
    bounce_stacked += 1u;
    bounce_kept += 1u;
    return vec3f(0.0);
}

// Sends both rays on their way; `direction` is the unit direction of the ray that hit.
fn bounce_split(s: Surface, m: Material, branch: Branch, direction: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    let level = branch.level + 1u;
    let cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    let transmitted = branch.weight * material_refraction(m, cosine, s.inside);
    if max(transmitted.x, max(transmitted.y, transmitted.z)) > 0.0 {
        let ratio = material_ratio(m, s.inside);
        let beyond = fresnel_transmitted(cosine, ratio);
        if material_is(m, OBJECT_THIN) {
            sum += bounce_push(surface_pass(s, branch.ray), transmitted, level, RAY_REFRACTION);
        } else if beyond > 0.0 {
            let refracted = fresnel_refracted(direction, s.normal, cosine, ratio, beyond);
            let cone = cone_bent(s, ratio, ratio * cosine - beyond);
            sum += bounce_push(surface_spawn(s, refracted, FAR, cone), transmitted, level, RAY_REFRACTION);
        }
    }
    let mirrored = branch.weight * material_mirror(m, cosine, s.inside);
    if max(mirrored.x, max(mirrored.y, mirrored.z)) <= 0.0 {
        return sum;
    }
    let reflected = surface_spawn(s, normalize(reflect(direction, s.normal)), FAR, cone_bent(s, 1.0, 2.0));
    return sum + bounce_push(reflected, mirrored, level, RAY_REFLECTION);
}

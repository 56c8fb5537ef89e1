// Mirror reflection and refraction: a tree of rays, walked with a stack of the branches still to come. What the
// depth limit or the weight cut leaves out is replaced by the environment's truncated radiance.

struct Branch {
    ray: Ray,
    weight: vec3f,
    level: u32,
    kind: u32,
}

var<private> bounce_stack: array<Branch, BOUNCE_STACK>;
var<private> bounce_stacked: u32;

// Keeps a branch for later, or replaces it.
fn bounce_branch(s: Surface, direction: vec3f, weight: vec3f, level: u32, kind: u32) -> vec3f {
    let largest = max(weight.x, max(weight.y, weight.z));
    if largest <= 0.0 {
        return vec3f(0.0);
    }
    if level > frame.depth || largest < frame.min_weight {
        return weight * frame.truncated;
    }
    bounce_stack[bounce_stacked] = Branch(surface_spawn(s, normalize(direction), FAR), weight, level, kind);
    bounce_stacked += 1u;
    return vec3f(0.0);
}

// Both branches of a surface.
fn bounce_split(s: Surface, m: Material, direction: vec3f, weight: vec3f, level: u32) -> vec3f {
    var sum = vec3f(0.0);
    let cosine = clamp(-dot(s.normal, direction), 0.0, 1.0);
    let transmitted = weight * material_refraction(m, cosine, s.inside);
    if max(transmitted.x, max(transmitted.y, transmitted.z)) > 0.0 {
        if material_is(m, OBJECT_THIN) {
            sum += bounce_branch(s, direction, transmitted, level, RAY_REFRACTION);
        } else {
            let ratio = select(1.0 / m.ior, m.ior, s.inside);
            let sine2 = ratio * ratio * (1.0 - cosine * cosine);
            if sine2 < 1.0 {
                let refracted = ratio * direction + (ratio * cosine - sqrt(1.0 - sine2)) * s.normal;
                sum += bounce_branch(s, refracted, transmitted, level, RAY_REFRACTION);
            }
        }
    }
    let mirrored = weight * material_mirror(m, cosine, s.inside);
    sum += bounce_branch(s, reflect(direction, s.normal), mirrored, level, RAY_REFLECTION);
    return sum;
}

fn bounce(first: Surface, first_material: Material, first_direction: vec3f) -> vec3f {
    bounce_stacked = 0u;
    var sum = bounce_split(first, first_material, first_direction, vec3f(1.0), 2u);
    while bounce_stacked > 0u {
        bounce_stacked -= 1u;
        let branch = bounce_stack[bounce_stacked];
        inspect_ray(branch.kind);
        let hit = bvh_traverse(branch.ray, false);
        if hit.primitive == MISS {
            sum += branch.weight * frame.background;
            continue;
        }
        let s = surface_at(branch.ray, hit);
        let m = material_at(s.object, s.texcoord, s.color);
        let direction = branch.ray.direction;
        let shadow = shadow_bits(s);
        sum += branch.weight * material_local(m, s.position, s.normal, -direction, s.inside, shadow);
        sum += bounce_split(s, m, direction, branch.weight, branch.level + 1u);
    }
    return sum;
}

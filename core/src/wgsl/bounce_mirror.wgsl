// Mirror reflection, level after level, until the depth limit or the weight cut. What is cut off is replaced
// by the environment's truncated radiance.

fn bounce(first: Surface, first_material: Material, first_direction: vec3f) -> vec3f {
    var surface = first;
    var material = first_material;
    var direction = first_direction;
    var weight = vec3f(1.0);
    var sum = vec3f(0.0);
    for (var level = 2u; ; level += 1u) {
        let cosine = clamp(-dot(surface.normal, direction), 0.0, 1.0);
        weight *= material_mirror(material, cosine, surface.inside);
        let largest = max(weight.x, max(weight.y, weight.z));
        if largest <= 0.0 {
            break;
        }
        if level > frame.depth || largest < frame.min_weight {
            sum += weight * frame.truncated;
            break;
        }
        direction = normalize(reflect(direction, surface.normal));
        let ray = surface_spawn(surface, direction, FAR);
        inspect_ray(RAY_REFLECTION);
        let hit = bvh_traverse(ray, false);
        if hit.primitive == MISS {
            sum += weight * frame.background;
            break;
        }
        surface = surface_at(ray, hit);
        material = material_at(surface.object, surface.texcoord, surface.color);
        let shadow = shadow_bits(surface);
        sum += weight * material_local(material, surface.position, surface.normal, -direction, surface.inside, shadow);
    }
    return sum;
}

// One traced sample: a primary ray with everything that follows from it (Whitted).

struct Sample {
    attributes: Attributes,
    color: vec3f,
}

fn sample_trace(pixel: vec2u) -> Sample {
    var result: Sample;
    result.attributes.color = vec3f(1.0);
    let ray = frame_ray(pixel);
    inspect_ray(RAY_PRIMARY);
    let hit = bvh_traverse(ray, false);
    if hit.primitive == MISS {
        result.attributes.depth = FAR;
        result.color = frame.background;
        return result;
    }
    let s = surface_at(ray, hit);
    let m = material_at(s.object, s.texcoord, s.color);
    let direction = normalize(ray.direction);
    result.attributes.depth = hit.t;
    result.attributes.object = s.object + 1u;
    result.attributes.normal = s.normal;
    result.attributes.shadow = shadow_bits(s);
    result.attributes.texcoord = texture_fold(s.object, s.texcoord);
    result.attributes.color = s.color;
    result.attributes.gcol = bounce(s, m, direction);
    result.color = result.attributes.gcol
        + material_local(m, s.position, s.normal, -direction, s.inside, result.attributes.shadow);
    return result;
}

// One traced sample: a primary ray with everything that follows from it (Whitted).

struct Sample {
    attributes: Attributes,
    color: vec3f,
    // Whether rays beyond the first hit were followed.
    bounced: bool,
}

fn sample_trace(pixel: vec2u) -> Sample {
    return sample_follow(frame_ray(pixel));
}

fn sample_follow(ray: Ray) -> Sample {
    secondary_begin();
    var result: Sample;
    result.attributes.color = vec3f(1.0);
    result.attributes.depth = FAR;
    var local = vec3f(0.0);
    var gcol = vec3f(0.0);
    var branch = Branch(ray, vec3f(1.0), 1u, RAY_PRIMARY);
    loop {
        inspect_ray(branch.kind);
        let hit = bvh_traverse(branch.ray, false);
        var arriving = frame.background;
        if hit.primitive != MISS {
            let direction = normalize(branch.ray.direction);
            let s = surface_at(branch.ray, hit);
            let m = material_at(s.object, s.texcoord, s.footprint, s.color);
            let shadow = shadow_bits(s);
            arriving = material_local(m, s.position, s.normal, -direction, s.inside, shadow);
            if branch.level == 1u {
                result.attributes.depth = hit.t;
                result.attributes.object = s.object + 1u;
                result.attributes.normal = s.normal;
                result.attributes.face = s.face;
                result.attributes.shadow = shadow;
                result.attributes.texcoord = texture_fold(s.object, s.texcoord);
                result.attributes.color = s.color;
                result.attributes.footprint = cone_attribute(s);
            } else if branch.level == 2u {
                secondary_hit(branch.weight, s, shadow);
            }
            gcol += bounce_split(s, m, branch, direction);
        }
        if branch.level == 1u {
            local = arriving;
        } else {
            gcol += branch.weight * arriving;
        }
        if !bounce_next(&branch) {
            break;
        }
        result.bounced = true;
    }
    result.attributes.gcol = gcol;
    result.color = gcol + local;
    return result;
}

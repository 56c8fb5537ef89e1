// Traces one sample: a primary ray and the rays that follow from it (Whitted 1980).

struct Sample {
    attributes: Attributes,
    color: vec3f,
    // Whether any ray beyond the first hit was traced.
    bounced: bool,
}

fn sample_trace(pixel: vec2u) -> Sample {
    return sample_follow(frame_ray(pixel));
}

fn sample_follow(ray: Ray) -> Sample {
    secondary_begin();
    var result: Sample;
    result.attributes.color = vec3f(1.0);
    result.attributes.alpha = 1.0;
    result.attributes.depth = FAR;
    var local = vec3f(0.0);
    var gcol = vec3f(0.0);
    // Radiance of the first mirrored ray, where it met nothing and the surface is all that the pixel shows.
    var mirrored = vec3f(-1.0);
    var whole = false;
    var state = PathState(ray, vec3f(1.0), 1u, RAY_PRIMARY);
    loop {
        inspect_ray(state.kind & RAY_KIND);
        let hit = media_trace(state.ray, state.kind & RAY_KIND);
        let direction = normalize(state.ray.direction);
        var arriving = vec3f(0.0);
        if hit.primitive == MISS {
            arriving = environment_missed(state.kind, direction);
            if MIRRORS_ENVIRONMENT && whole && state.level == 2u && (state.kind & RAY_KIND) == RAY_REFLECTION {
                mirrored = state.weight * arriving;
            }
        } else {
            let smooth_surface = media_surface(surface_at(state.ray, hit));
            var s = smooth_surface;
            let m = media_material(surface_material(&s, direction), s);
            let shadow = shadow_bits(smooth_surface);
            arriving = material_local(m, s.position, s.normal, -direction, s.inside, shadow);
            if state.level == 1u {
                result.attributes.depth = hit.t;
                result.attributes.object = s.object + 1u;
                result.attributes.normal = smooth_surface.normal;
                result.attributes.face = s.face;
                result.attributes.shadow = shadow;
                result.attributes.texcoord = texture_fold(s.object, s.texcoord);
                result.attributes.color = s.color;
                result.attributes.alpha = s.alpha;
                result.attributes.footprint = cone_attribute(s);
                result.attributes.maps = s.maps;
            } else if state.level == 2u {
                secondary_hit(state.weight, smooth_surface, shadow);
            }
            state.weight *= media_absorbed(s, state.ray);
            straight_continue(&state, s, &gcol);
            if state.level == 1u {
                whole = !s.inside && all(state.weight == vec3f(1.0));
            }
            shadow_add_dimmed(s, m, -direction, state.weight, &gcol);
            gcol += scatter(s, m, state, direction);
        }
        if state.level == 1u {
            local = state.weight * arriving;
        } else {
            gcol += state.weight * arriving;
        }
        if !scatter_next(&state) {
            break;
        }
        result.bounced = true;
    }
    result.attributes.gcol = gcol;
    result.attributes.mirrors_environment = all(gcol == mirrored);
    result.color = gcol + local;
    return result;
}

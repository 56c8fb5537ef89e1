// Shadow rays in scenes with partial coverage: bit i is also set if surfaces dim light i. What they leave of it is
// not in the radiance that interpolated samples compute anew, but in that of secondary rays.

// Share of each light that arrives.
var<private> shadow_shares: array<f32, 32>;

fn shadow_bits(s: Surface) -> u32 {
    var bits = 0u;
    for (var i = 0u; i < lights_count(); i += 1u) {
        shadow_shares[i] = 1.0;
        let lit = translucency_side(s, lights_arrival(i, s.position).direction);
        let origin = lit.position + lit.offset * lit.face;
        let arrival = lights_arrival(i, origin);
        if dot(lit.normal, arrival.direction) <= 0.0 && !material_has_normal_map(s.object) {
            continue;
        }
        let share = shadow_arriving(lit, i, origin, arrival);
        shadow_shares[i] = share;
        bits |= select(0u, 1u << i, share < 1.0);
    }
    return bits;
}

// Share of the light that arrives along a ray.
fn shadow_along(ray: Ray) -> f32 {
    inspect_ray(RAY_SHADOW);
    any_hit_through = 1.0;
    let hit = bvh_traverse(ray, true);
    return select(0.0, any_hit_through, hit.primitive == MISS);
}

fn shadow_share(bits: u32, light: u32) -> f32 {
    return shadow_shares[light];
}

// Adds the direct light, times `weight`, that arrives dimmed; `view` is the unit vector to the viewer.
fn shadow_add_dimmed(s: Surface, m: Material, view: vec3f, weight: vec3f, sum: ptr<function, vec3f>) {
    if material_is(m, OBJECT_UNLIT) {
        return;
    }
    let cosine = clamp(dot(s.normal, view), 0.0, 1.0);
    let diffuse = material_diffuse(m, cosine, s.inside);
    let behind = translucency_albedo(m, cosine, s.inside);
    for (var i = 0u; i < lights_count(); i += 1u) {
        let share = shadow_shares[i];
        if share > 0.0 && share < 1.0 {
            let alone = ~(1u << i);
            *sum += weight * share * lights_reflected(m, diffuse, s.position, s.normal, view, alone);
            *sum += weight * share * translucency_lit(behind, s.position, s.normal, alone);
            *sum += weight * share * coat_lit(m, s.position, view, alone);
        }
    }
}

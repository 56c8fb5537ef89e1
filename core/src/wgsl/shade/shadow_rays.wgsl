// Traces a shadow ray for each light; bit i is set if light i does not reach the point (SHDBIT). A light behind
// the shading normal contributes nothing in any case and gets no ray.

fn shadow_bits(s: Surface) -> u32 {
    var bits = 0u;
    for (var i = 0u; i < lights_count(); i += 1u) {
        let lit = translucency_side(s, lights_arrival(i, s.position).direction);
        let origin = lit.position + lit.offset * lit.face;
        let arrival = lights_arrival(i, origin);
        if dot(lit.normal, arrival.direction) <= 0.0 && !material_has_normal_map(s.object) {
            continue;
        }
        bits |= select(0u, 1u << i, shadow_arriving(lit, i, origin, arrival) == 0.0);
    }
    return bits;
}

// Share of the light that arrives along a ray: 0 or 1.
fn shadow_along(ray: Ray) -> f32 {
    inspect_ray(RAY_SHADOW);
    return select(0.0, 1.0, bvh_traverse(ray, true).primitive == MISS);
}

// Share of a light that arrives.
fn shadow_share(bits: u32, light: u32) -> f32 {
    return select(0.0, 1.0, (bits & (1u << light)) == 0u);
}

fn shadow_add_dimmed(s: Surface, m: Material, view: vec3f, weight: vec3f, sum: ptr<function, vec3f>) {}

// Share of a light that arrives at the smooth surface that the shading normals stand for. Where a light is in front of
// the shading normal but behind the face, the face would shadow itself: the shadow ray starts on the curved surface
// above it instead (Hanika 2021, "Hacking the Shadow Terminator"). A ray to that point comes first and the second ray
// does not leave out the face, so that no light leaks through surfaces.

fn shadow_arriving(s: Surface, light: u32, origin: vec3f, arrival: Arrival) -> f32 {
    var ray = Ray(origin, lights_reach(light, arrival.distance), arrival.direction, s.primitive, 0.0, vec2f(0.0));
    var lifts = dot(s.face, arrival.direction) <= 0.0;
    if lifts {
        ray.direction = terminator_lift(s);
        ray.t_max = 1.0;
        if dot(s.normal, arrival.direction) <= 0.0 || dot(s.face, ray.direction) <= s.offset {
            return 0.0;
        }
    }
    var share = 1.0;
    loop {
        share *= shadow_along(ray);
        if share == 0.0 || !lifts {
            break;
        }
        lifts = false;
        let lifted = origin + ray.direction;
        let above = lights_arrival(light, lifted);
        ray = Ray(lifted, lights_reach(light, above.distance), above.direction, MISS, 0.0, vec2f(0.0));
    }
    return share;
}

// Vector from the face to the curved surface: the mean, by barycentric weights, of the vectors to the planes through the
// corners at right angles to their normals, as far as these lie above the face.
fn terminator_lift(s: Surface) -> vec3f {
    if sphere_is(s.primitive) {
        return vec3f(0.0);
    }
    let corners = bvh_corners(s.primitive);
    let normals = shading_at(s.primitive).xyz;
    let weights = vec3f(1.0 - s.barycentric.x - s.barycentric.y, s.barycentric);
    var lift = vec3f(0.0);
    for (var i = 0u; i < 3u; i += 1u) {
        let normal = select(1.0, -1.0, s.inside) * octahedral_decode(normals[i]);
        lift -= weights[i] * min(dot(s.position - corners[i], normal), 0.0) * normal;
    }
    return lift;
}

// The caller's rays.

struct ProbeRay {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    any: u32,
    // 1 + the primitive that the ray starts on, 0 for none.
    left: u32,
    // Ray cone: width at the origin and growth per unit of length.
    width: f32,
    growth: f32,
    padding: u32,
}

var<storage, read> rays: array<ProbeRay>;

fn probe_index(group: vec3u, local: u32) -> u32 {
    return (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
}

fn probe_ray(index: u32) -> Ray {
    let ray = rays[index];
    return Ray(ray.origin, ray.t_max, ray.direction, ray.left - 1u, 0.0, vec2f(ray.width, length(ray.direction) * ray.growth));
}

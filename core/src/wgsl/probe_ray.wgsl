// Rays of the caller's.

struct ProbeRay {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    any: u32,
    // 1 + the primitive that the ray leaves, 0 for none.
    left: u32,
    padding0: u32,
    padding1: u32,
    padding2: u32,
}

var<storage, read> rays: array<ProbeRay>;

fn probe_index(group: vec3u, local: u32) -> u32 {
    return (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
}

fn probe_ray(index: u32) -> Ray {
    return Ray(rays[index].origin, rays[index].t_max, rays[index].direction, rays[index].left - 1u, 0.0);
}

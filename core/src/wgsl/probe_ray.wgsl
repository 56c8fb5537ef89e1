// Rays of the caller's.

struct ProbeRay {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    any: u32,
}

var<storage, read> rays: array<ProbeRay>;

fn probe_index(group: vec3u, local: u32) -> u32 {
    return (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
}

fn probe_ray(index: u32) -> Ray {
    return Ray(rays[index].origin, rays[index].t_max, rays[index].direction);
}

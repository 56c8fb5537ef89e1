// Traces the caller's rays and returns their closest hits.

struct ProbeHit {
    t: f32,
    primitive: u32,
    object: u32,
    u: f32,
    v: f32,
}

var<storage, read_write> results: array<ProbeHit>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = probe_index(group, local);
    if index >= arrayLength(&rays) {
        return;
    }
    let ray = probe_ray(index);
    var hit: Hit;
    if rays[index].any != 0u {
        hit = bvh_traverse(ray, true);
    } else {
        hit = bvh_traverse(ray, false);
    }
    var object = 0u;
    if hit.primitive != MISS {
        object = shading_at(hit.primitive).w & SURFACE_OBJECT;
    }
    results[index] = ProbeHit(hit.t, hit.primitive, object, hit.u, hit.v);
}

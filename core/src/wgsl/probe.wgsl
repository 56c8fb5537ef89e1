// Rays of the caller's.

struct ProbeRay {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    any: u32,
}

struct ProbeHit {
    t: f32,
    primitive: u32,
    object: u32,
    u: f32,
    v: f32,
}

var<storage, read> rays: array<ProbeRay>;
var<storage, read_write> hits: array<ProbeHit>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
    if index >= arrayLength(&rays) {
        return;
    }
    let ray = Ray(rays[index].origin, rays[index].t_max, rays[index].direction);
    var hit: Hit;
    if rays[index].any != 0u {
        hit = bvh_traverse(ray, true);
    } else {
        hit = bvh_traverse(ray, false);
    }
    var object = 0u;
    if hit.primitive != MISS {
        object = shading[hit.primitive].w & SURFACE_OBJECT;
    }
    hits[index] = ProbeHit(hit.t, hit.primitive, object, hit.u, hit.v);
}

// Returns hit points, and the origins of rays that leave the surface on either side.

struct ProbeSpawn {
    position: vec3f,
    // MISS if nothing is hit; all other fields are then zero.
    primitive: u32,
    normal: vec3f,
    object: u32,
    face: vec3f,
    inside: u32,
    // Origins of rays on the viewer's side of the face and on the other.
    above: vec3f,
    t: f32,
    below: vec3f,
    offset: f32,
}

var<storage, read_write> results: array<ProbeSpawn>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = probe_index(group, local);
    if index >= arrayLength(&rays) {
        return;
    }
    let ray = probe_ray(index);
    let hit = bvh_traverse(ray, false);
    var result: ProbeSpawn;
    result.primitive = hit.primitive;
    if hit.primitive != MISS {
        let s = surface_at(ray, hit);
        result.position = s.position;
        result.normal = s.normal;
        result.object = s.object;
        result.face = s.face;
        result.inside = select(0u, 1u, s.inside);
        result.above = surface_spawn(s, s.face, FAR, vec2f(0.0)).origin;
        result.t = hit.t;
        result.below = surface_spawn(s, -s.face, FAR, vec2f(0.0)).origin;
        result.offset = s.offset;
    }
    results[index] = result;
}

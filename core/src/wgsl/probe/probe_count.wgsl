// Counts the surfaces that the caller's rays pass through.

var<storage, read_write> results: array<u32>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = probe_index(group, local);
    if index >= arrayLength(&rays) {
        return;
    }
    let hit = bvh_traverse(probe_ray(index), false);
    results[index] = any_hit_counted + select(0u, 1u, hit.primitive != MISS);
}

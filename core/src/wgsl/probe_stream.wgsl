// As many bytes as the device moves: reads and writes a buffer that no cache holds.

var<storage, read_write> stream: array<vec4f>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let first = group.x * TRACE_GROUP * PEAK_STEPS + local;
    for (var step = 0u; step < PEAK_STEPS; step += 1u) {
        let i = first + step * TRACE_GROUP;
        stream[i] = stream[i] + vec4f(1.0);
    }
}

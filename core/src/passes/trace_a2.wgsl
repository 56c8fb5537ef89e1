// Step-III-c: full tracing of the listed pixels; their attributes are not needed any more.

var<storage, read> list: List;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = (group.y * TRACE_ROW + group.x) * TRACE_GROUP + local;
    if index >= list.count {
        return;
    }
    let pixel = list_pixel(list.pixels[index]);
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    inspect_pixel(pixel, ORIGIN_TRACED_A2, traced.attributes);
}

// Step-II-c: full tracing of the listed pixels.

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
    attributes_store(pixel, traced.attributes);
    inspect_pixel(pixel, ORIGIN_TRACED_A1, traced.attributes);
}

// Step-II-c and Step-III-c: full tracing of the listed pixels. Attributes are kept for the rows of the base pixels
// alone; nothing refers to the others any more.

var<storage, read> list: List;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = frame.first + group.x * TRACE_GROUP + local;
    if index >= list.count {
        return;
    }
    let pixel = list_pixel(list.pixels[index]);
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    if pixel.y % 2u == 0u {
        attributes_store(pixel, traced.attributes);
    }
    inspect_pixel(pixel, select(ORIGIN_TRACED_A2, ORIGIN_TRACED_A1, pixel.y % 2u == 0u), traced.attributes);
}

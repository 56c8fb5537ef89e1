// Step-II-c and Step-III-c (Kim 2016, Table 2): traces the pixels that the step before has listed.

var<storage, read> list: List;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let pixel = list_pixel(list.pixels[index]);
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    attributes_keep(pixel, traced.attributes, ATTRIBUTES_TRACED);
    pixel_edges_record(pixel, traced.attributes, secondary_packed(), traced.color);
    inspect_pixel(pixel, select(ORIGIN_TRACED_A1, ORIGIN_TRACED_A2, list_between_rows(pixel)), traced.attributes);
}

// Step-I (Kim 2016, Table 2): traces each base pixel and stores its colour and attributes.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * tile_order(group, groups, TILE_ORDER_SINGLE) + frame_tile(local);
    let pixel = frame.part.stride * at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    attributes_keep(pixel, traced.attributes, ATTRIBUTES_TRACED);
    pixel_edges_record(pixel, traced.attributes, secondary_packed(), traced.color);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

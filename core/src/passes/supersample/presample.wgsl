// Presampler (Jin 2009, 4.1.2, 4.3.1): traces a ray through each pixel's centre and stores its colour and
// compared attributes.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * tile_order(group, groups, TILE_ORDER_SINGLE) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    pixel_edges_record(pixel, traced.attributes, secondary_packed(), traced.color);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

// Full ray tracing: traces every sample.

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
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

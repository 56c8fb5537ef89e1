// Traces the initial quincunx: a sample in the centre of each pixel and one at each corner.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * tile_order(group, groups, TILE_ORDER_SINGLE) + frame_tile(local);
    let pixel = vec2u(at.x / 2u, at.y + frame.part.row);
    let centred = at.x % 2u == 1u;
    let beyond = vec2u(frame.size.x, frame.part.end) + select(1u, 0u, centred);
    if any(pixel >= beyond) {
        return;
    }
    let point = 8u * vec2u(pixel.x, at.y) + select(0u, 4u, centred);
    let traced = sample_follow(quincunx_ray(point));
    quincunx_store(point, traced.color);
    if centred {
        inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
    } else {
        inspect_extra(quincunx_pixel(point));
    }
}

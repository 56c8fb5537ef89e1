// Frameless rendering: the pixels whose turn it is, tile by tile; the picture keeps the others.

@compute @workgroup_size(TRACE_GROUP)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = order_tile(group, groups, ORDER_SINGLY);
    let index = at.x * TRACE_GROUP + local;
    let tile = frame.part.first + index / frame.renewed;
    let across = (frame.size.x + RANK_TILE - 1u) / RANK_TILE;
    let corner = RANK_TILE * vec2u(tile % across, tile / across);
    let rank = frame.renewed_from + index % frame.renewed;
    frameless_trace(corner + renewal_pixel(rank));
    if COUNTS {
        for (var kept = frame.renewed + index % frame.renewed; kept < RANKS; kept += frame.renewed) {
            frameless_keep(corner + renewal_pixel(frame.renewed_from + kept));
        }
    }
}

fn frameless_trace(pixel: vec2u) {
    if any(pixel >= frame.size) {
        return;
    }
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

fn frameless_keep(pixel: vec2u) {
    if all(pixel < frame.size) {
        inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
    }
}

// Frameless rendering: traces the pixels whose rank is due, tile by tile; the image keeps the others.

@compute @workgroup_size(TRACE_GROUP)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = tile_order(group, groups, TILE_ORDER_SINGLE);
    let index = at.x * TRACE_GROUP + local;
    let tile = frame.part.first + index / frame.refresh_count;
    let across = (frame.size.x + RANK_TILE - 1u) / RANK_TILE;
    let corner = RANK_TILE * vec2u(tile % across, tile / across);
    let rank = frame.refresh_first + index % frame.refresh_count;
    frameless_trace(corner + refresh_pixel(rank));
    if COUNTS {
        for (var kept = frame.refresh_count + index % frame.refresh_count; kept < RANKS; kept += frame.refresh_count) {
            frameless_keep(corner + refresh_pixel(frame.refresh_first + kept));
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

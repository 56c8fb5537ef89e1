// Which pixels are refined: those of which Jin's test finds a quarter active.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * order_tile(group, groups, ORDER_RUNS) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    let test = quarters_test(pixel);
    inactive_output(pixel, test.quarters);
    inspect_edges(pixel, test.differing << 4u);
    attributes_write(edges_place(pixel, EDGE_ROUND), select(0u, 1u, test.quarters != 0u));
    if test.quarters != 0u {
        refine_append(pixel, 0u);
    }
}

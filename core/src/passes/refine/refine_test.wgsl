// Lists the pixels to refine: those with a subpixel that Jin's test (2009, 4.2.2) finds active.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * tile_order(group, groups, TILE_ORDER_RUN) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    let test = subpixels_test(pixel);
    unsampled_output(pixel, test.subpixels);
    inspect_edges(pixel, test.differing << 4u);
    attributes_write(pixel_edges_place(pixel, PIXEL_EDGE_ROUND), select(0u, 1u, test.subpixels != 0u));
    if test.subpixels != 0u {
        refine_append(pixel, 0u);
    }
}

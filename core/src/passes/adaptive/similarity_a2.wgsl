// Step-III-a (Kim 2016, Table 2): interpolates or lists the samples of the rows half way between those of the
// references.

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 16u * tile_order(group, groups, TILE_ORDER_RUN) + frame_tile(local);
    let reach = vec2u(0u, frame.part.stride / 2u);
    let pixel = vec2u(reach.y, frame.part.stride) * at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    similarity_step(pixel, pixel - reach, pixel + reach);
}

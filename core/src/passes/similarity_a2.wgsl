// Step-III-a: the rows between those of the base pixels; their attributes are not needed any more.

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 16u * order_tile(group, groups, ORDER_RUNS) + frame_tile(local);
    let pixel = vec2u(1u, 2u) * at + vec2u(0u, 1u);
    if any(pixel >= frame.size) {
        return;
    }
    similarity_step(pixel, pixel - vec2u(0u, 1u), pixel + vec2u(0u, 1u));
}

// Step-II-a: the pixels between two base pixels of a row.

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 16u * order_tile(group, groups, ORDER_RUNS) + frame_tile(local);
    let pixel = vec2u(2u, 2u) * at + vec2u(1u, 0u);
    if any(pixel >= frame.size) {
        return;
    }
    let step = similarity_step(pixel, pixel - vec2u(1u, 0u), pixel + vec2u(1u, 0u));
    if step.interpolated {
        attributes_store(pixel, step.attributes);
    }
}

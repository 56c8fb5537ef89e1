// A level of the a-trous filter: 3x3 pixels, twice as far apart as in the level before, with binomial weights.

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 16u * order_tile(group, groups, ORDER_RUNS) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let words = filtered_before[guides_place(pixel)];
    if words.y == 0u {
        atrous_unfiltered(pixel);
        return;
    }
    let own = atrous_pixel(pixel, words);
    var sum = vec3f(0.0);
    var weights = 0.0;
    for (var y = -1; y <= 1; y += 1) {
        for (var x = -1; x <= 1; x += 1) {
            let at = vec2i(pixel) + frame.step * vec2i(x, y);
            let tap = vec2u(clamp(at, vec2i(0), vec2i(frame.size) - 1));
            let q = filtered_before[guides_place(tap)];
            let counts = all(tap == vec2u(at)) && eyes_same(pixel, tap);
            let binomial = f32((2 - abs(x)) * (2 - abs(y)));
            let weight = select(0.0, binomial * atrous_weight(own, vec2f(vec2i(x, y)), q), counts);
            sum += weight * bitcast<f32>(q.z) * vec3f(unpack2x16unorm(q.w), 1.0);
            weights += weight;
        }
    }
    let light = vec3f(sum.xy, max(sum.z - sum.x - sum.y, 0.0)) / weights;
    atrous_result(pixel, words, light);
}

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
    let guide = guides[guides_place(pixel)];
    let kind = guides_kind(guide);
    if kind == GUIDE_NONE {
        atrous_unfiltered(pixel);
        return;
    }
    let own = atrous_pixel(pixel, guide);
    var sum = 4.0 * own.light;
    var weights = 4.0;
    for (var i = 0u; i < 9u; i += 1u) {
        let offset = vec2i(vec2u(i % 3u, i / 3u)) - 1;
        let tap = vec2i(pixel) + frame.step * offset;
        if i == 4u || !noise_reaches(pixel, tap) {
            continue;
        }
        let other = guides[guides_place(vec2u(tap))];
        if guides_kind(other) != kind {
            continue;
        }
        let q = atrous_pixel(vec2u(tap), other);
        let weight = f32((2 - abs(offset.x)) * (2 - abs(offset.y))) * atrous_weight(own, q, kind);
        sum += weight * q.light;
        weights += weight;
    }
    atrous_result(pixel, guide, sum / weights);
}

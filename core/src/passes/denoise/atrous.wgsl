// One level of the a-trous filter (Dammertz et al. 2010): averages a pixel and four taps around it, at twice the
// distance of the level before, alternately axis-aligned and diagonal. Loads dominate the cost of a level, and
// 3x3 taps would gain little.

fn atrous_side(index: i32) -> vec2i {
    let turn = vec2i(index & 1, index >> 1u) * 2 - 1;
    let beside = select(vec2i(0, turn.x), vec2i(turn.x, 0), turn.y < 0);
    // The pattern turns by 45 degrees from level to level: diagonal for steps of 1 and 4.
    return select(turn, beside, (frame.part.step.x & 5) != 0);
}

// Decodes a pixel's light, stored as its sum and the shares of two channels: both channels and the sum.
fn atrous_light(words: vec4u) -> vec3f {
    return bitcast<f32>(words.z) * vec3f(unpack2x16unorm(words.w), 1.0);
}

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 16u * tile_order(group, groups, TILE_ORDER_RUN) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let words = atrous_buffer_before[gbuffer_place(pixel)];
    if words.y == 0u {
        atrous_unfiltered(pixel);
        return;
    }
    let own = atrous_pixel(pixel, words);
    var sum = atrous_light(words);
    var weights = 1.0;
    for (var i = 0; i < 4; i += 1) {
        let side = atrous_side(i);
        let at = vec2i(pixel) + frame.part.step * side;
        let tap = vec2u(clamp(at, vec2i(0), vec2i(frame.size) - 1));
        let q = atrous_buffer_before[gbuffer_place(tap)];
        let counts = all(tap == vec2u(at)) && eyes_same(pixel, tap);
        let weight = select(0.0, atrous_weight(own, vec2f(side), q), counts);
        sum += weight * atrous_light(q);
        weights += weight;
    }
    let light = vec3f(sum.xy, max(sum.z - sum.x - sum.y, 0.0)) / weights;
    atrous_result(pixel, words, light);
}

// Pixels whose last path was stopped on diffuse surfaces show the median of their 3x3 pixels, channel by channel (Kim & Sung
// 2021, Algorithm 5, lines 10 to 14). What lies outside the picture counts as the pixel itself.

// The median of nine by 19 exchanges (Smith 1996, "Implementing median filters in XC4000E FPGAs").
fn median_of(values: array<vec3f, 9>) -> vec3f {
    var v = values;
    for (var i = 0u; i < 19u; i += 1u) {
        let a = MEDIAN_EXCHANGES[i].x;
        let b = MEDIAN_EXCHANGES[i].y;
        let low = min(v[a], v[b]);
        v[b] = max(v[a], v[b]);
        v[a] = low;
    }
    return v[4];
}

const MEDIAN_EXCHANGES: array<vec2u, 19> = array(
    vec2u(1u, 2u), vec2u(4u, 5u), vec2u(7u, 8u), vec2u(0u, 1u), vec2u(3u, 4u), vec2u(6u, 7u), vec2u(1u, 2u),
    vec2u(4u, 5u), vec2u(7u, 8u), vec2u(0u, 3u), vec2u(5u, 8u), vec2u(4u, 7u), vec2u(3u, 6u), vec2u(1u, 4u),
    vec2u(2u, 5u), vec2u(4u, 7u), vec2u(4u, 2u), vec2u(6u, 4u), vec2u(4u, 2u),
);

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
    let own = noise_mean(pixel);
    if guides[guides_place(pixel)].w == 0u {
        output(pixel, own);
        return;
    }
    var values: array<vec3f, 9>;
    for (var i = 0u; i < 9u; i += 1u) {
        let tap = vec2i(pixel) + vec2i(vec2u(i % 3u, i / 3u)) - 1;
        values[i] = own;
        if noise_reaches(pixel, tap) {
            values[i] = noise_mean(vec2u(tap));
        }
    }
    output(pixel, median_of(values));
}

// Box filter: a pixel is the mean of its own samples.

fn filter_pixel(pixel: vec2u) -> vec3f {
    return filter_sum(SAMPLING * pixel) / f32(SAMPLING * SAMPLING);
}

// The sum of a pixel's samples. Sixteen are summed in groups of four in sampling order, bitwise like extra
// samples.
fn filter_sum(first: vec2u) -> vec3f {
    var sum = vec3f(0.0);
    if SAMPLING == 4u {
        for (var i = 0u; i < 16u; i += 4u) {
            let a = samples_load(first + sample_order_stratum(i));
            let b = samples_load(first + sample_order_stratum(i + 1u));
            let c = samples_load(first + sample_order_stratum(i + 2u));
            let d = samples_load(first + sample_order_stratum(i + 3u));
            sum += a + b + c + d;
        }
        return sum;
    }
    for (var y = 0u; y < SAMPLING; y += 1u) {
        for (var x = 0u; x < SAMPLING; x += 1u) {
            sum += samples_load(first + vec2u(x, y));
        }
    }
    return sum;
}

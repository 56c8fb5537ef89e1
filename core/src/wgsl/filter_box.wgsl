// Box filter: a pixel is the average of its own samples.

fn filter_pixel(pixel: vec2u) -> vec3f {
    return filter_sum(SAMPLING * pixel) / f32(SAMPLING * SAMPLING);
}

// The sum of a pixel's samples. In fours, where that goes: a pixel of 16 is then to the last bit what extra samples make
// of it.
fn filter_sum(first: vec2u) -> vec3f {
    var sum = vec3f(0.0);
    if SAMPLING % 2u == 1u {
        for (var y = 0u; y < SAMPLING; y += 1u) {
            for (var x = 0u; x < SAMPLING; x += 1u) {
                sum += samples_load(first + vec2u(x, y));
            }
        }
        return sum;
    }
    for (var y = 0u; y < SAMPLING; y += 2u) {
        for (var x = 0u; x < SAMPLING; x += 2u) {
            let a = samples_load(first + vec2u(x, y));
            let b = samples_load(first + vec2u(x + 1u, y));
            let c = samples_load(first + vec2u(x, y + 1u));
            let d = samples_load(first + vec2u(x + 1u, y + 1u));
            sum += a + b + c + d;
        }
    }
    return sum;
}

// Tent filter: along both axes a sample's weight falls linearly with its distance from the pixel's centre, to
// zero at the centres of the neighbours.

fn filter_pixel(pixel: vec2u) -> vec3f {
    let center = (vec2f(pixel) + 0.5) * f32(SAMPLING);
    let first = vec2i(SAMPLING * pixel) - i32(SAMPLING);
    var sum = vec3f(0.0);
    var weights = 0.0;
    for (var y = 0; y < 3 * i32(SAMPLING); y += 1) {
        for (var x = 0; x < 3 * i32(SAMPLING); x += 1) {
            let sample = first + vec2i(x, y);
            if any(sample < vec2i(0)) || any(sample >= vec2i(frame.size)) {
                continue;
            }
            let place = vec2f(sample) + jitter_in(vec2u(sample));
            let near = max(vec2f(0.0), 1.0 - abs(place - center) / f32(SAMPLING));
            let weight = near.x * near.y;
            if weight > 0.0 {
                sum += weight * samples_load(vec2u(sample));
                weights += weight;
            }
        }
    }
    return sum / weights;
}

// The history that a frame leaves for the next one: for each pixel the world-space point that it shows (FAR if
// that is not valid from other positions), and its radiance.

var<storage, read_write> history: array<f32>;

fn history_store(pixel: vec2u, point: vec3f, radiance: vec3f) {
    let place = 6u * (pixel.y * frame.size.x + pixel.x);
    for (var axis = 0u; axis < 3u; axis += 1u) {
        history[place + axis] = point[axis];
        history[place + 3u + axis] = radiance[axis];
    }
}

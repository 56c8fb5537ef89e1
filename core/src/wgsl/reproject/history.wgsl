// What a frame leaves for the next one: of each pixel the point in the scene that it shows (FAR if it
// is not to be seen from elsewhere), and its radiance.

var<storage, read_write> history: array<f32>;

fn history_store(pixel: vec2u, point: vec3f, radiance: vec3f) {
    let place = 6u * (pixel.y * frame.size.x + pixel.x);
    for (var axis = 0u; axis < 3u; axis += 1u) {
        history[place + axis] = point[axis];
        history[place + 3u + axis] = radiance[axis];
    }
}

// Reads the history buffer that the last frame has written.

var<storage, read> history_before: array<f32>;

fn history_point(index: u32) -> vec3f {
    return vec3f(history_before[6u * index], history_before[6u * index + 1u], history_before[6u * index + 2u]);
}

fn history_radiance(index: u32) -> vec3f {
    let place = 6u * index + 3u;
    return vec3f(history_before[place], history_before[place + 1u], history_before[place + 2u]);
}

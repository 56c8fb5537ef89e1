// Box filter (Kim 2016, 6.1): a pixel is the average of its samples' radiances.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = 16u * (group.xy + vec2u(0u, frame.first)) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.row);
    if pixel.x >= frame.size.x / SAMPLING || pixel.y >= frame.end {
        return;
    }
    var sum = vec3f(0.0);
    for (var y = 0u; y < SAMPLING; y += 1u) {
        for (var x = 0u; x < SAMPLING; x += 1u) {
            sum += samples_load(SAMPLING * pixel + vec2u(x, y));
        }
    }
    output(pixel, sum / f32(SAMPLING * SAMPLING));
}

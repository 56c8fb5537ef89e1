// Fills the light squares of a checkerboard with the average of their two to four traced neighbours.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    if ((pixel.x + pixel.y) & 1u) == 0u {
        output(pixel, samples_load(pixel));
        return;
    }
    var sum = vec3f(0.0);
    var count = 0.0;
    for (var side = 0u; side < 4u; side += 1u) {
        let step = select(vec2i(0, 1), vec2i(1, 0), side < 2u) * (1 - 2 * i32(side & 1u));
        let neighbour = vec2i(pixel) + step;
        if all(neighbour >= vec2i(0)) && all(neighbour < vec2i(frame.size)) {
            sum += samples_load(vec2u(neighbour));
            count += 1.0;
        }
    }
    output(pixel, sum / count);
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, Attributes());
}

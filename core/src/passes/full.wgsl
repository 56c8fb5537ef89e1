// Full ray tracing: every pixel.

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let pixel = id.xy;
    if any(pixel >= frame.size) {
        return;
    }
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

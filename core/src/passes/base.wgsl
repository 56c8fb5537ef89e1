// Step-I (Kim 2016, Table 2): a ray through each base pixel, its colour and its attributes.

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let pixel = 2u * id.xy;
    if any(pixel >= frame.size) {
        return;
    }
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    attributes_store(pixel, traced.attributes);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

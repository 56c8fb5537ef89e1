// Step-II-a: the pixels between two base pixels of a row.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2u(2u * id.x + 1u, 2u * id.y);
    if any(pixel >= frame.size) {
        return;
    }
    let step = similarity_step(pixel, pixel - vec2u(1u, 0u), pixel + vec2u(1u, 0u));
    if step.interpolated {
        attributes_store(pixel, step.attributes);
    }
}

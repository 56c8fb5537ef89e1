// Step-III-a: the rows between those of the base pixels; their attributes are not needed any more.

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2u(id.x, 2u * id.y + 1u);
    if any(pixel >= frame.size) {
        return;
    }
    similarity_step(pixel, pixel - vec2u(0u, 1u), pixel + vec2u(0u, 1u));
}

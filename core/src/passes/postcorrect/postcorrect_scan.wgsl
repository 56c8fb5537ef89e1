// Step-IV as in Kim 2016, section 5: a thread for each row or column traces every pixel that differs from the
// traced pixel before it.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let line = frame.part.first + group.x * TRACE_GROUP + local;
    let along_rows = frame.part.step.x != 0;
    let rows = frame.part.end - frame.part.row;
    if line >= select(frame.size.x, rows, along_rows) {
        return;
    }
    let low = select(vec2u(line, frame.part.row), vec2u(0u, frame.part.row + line), along_rows);
    let far = select(vec2u(0u, rows - 1u), vec2u(frame.size.x - 1u, 0u), along_rows);
    var pixel = low + select(vec2u(0u), far, any(frame.part.step < vec2i(0)));
    for (var left = far.x + far.y; left > 0u; left -= 1u) {
        let next = pixel + vec2u(frame.part.step);
        if attributes_traced(pixel) && attributes_claim(next, attributes_load_identity(pixel)) {
            inspect_claimed();
            let traced = sample_trace(next);
            output(next, traced.color);
            pixel_edges_record(next, traced.attributes, secondary_packed(), traced.color);
            inspect_pixel(next, ORIGIN_POSTCORRECTED, traced.attributes);
            attributes_store_identity(next, traced.attributes);
        }
        pixel = next;
    }
}

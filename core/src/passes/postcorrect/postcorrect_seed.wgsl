// Step-IV (Kim 2016, section 4): lists the interpolated neighbours that differ from a traced adaptive pixel.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let pixel = list_pixel(list.pixels[index]);
    let identity = attributes_load_identity(pixel);
    for (var side = 0u; side < 4u; side += 1u) {
        let neighbour = postcorrect_neighbour(pixel, side);
        if postcorrect_claim(neighbour, identity) {
            list_append(neighbour);
        }
    }
}

// Step-IV (Kim 2016, section 4): traces the listed pixels and goes on from them. Deviation: a frontier instead of scans
// along rows and columns. A thread walks from pixel to pixel while it finds neighbours that differ, and lists those that
// it cannot go to itself for the next round. Which pixels are traced does not depend on the order: comparisons are
// between a traced pixel and what was interpolated, and neither changes any more.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    var pixel = list_pixel(list.pixels[index]);
    // All threads together trace no more than a round may.
    let share = ROUND_SAMPLES / (list.end - list.begin);
    for (var steps = clamp(share, 1u, postcorrect_steps()); steps > 0u; steps -= 1u) {
        let traced = sample_trace(pixel);
        output(pixel, traced.color);
        inspect_pixel(pixel, ORIGIN_POSTCORRECTED, traced.attributes);
        let identity = attributes_identity(traced.attributes.object, traced.attributes.shadow);
        var next = pixel;
        for (var side = 0u; side < 4u; side += 1u) {
            let neighbour = postcorrect_neighbour(pixel, side);
            if postcorrect_claim(neighbour, identity) {
                if steps > 1u && all(next == pixel) {
                    next = neighbour;
                } else {
                    list_append(neighbour);
                }
            }
        }
        if all(next == pixel) {
            return;
        }
        pixel = next;
    }
}

// The longest straight run of a band, twice over, in all rounds.
fn postcorrect_steps() -> u32 {
    return 2u * (frame.size.x + frame.end - frame.row) / ROUNDS + 1u;
}

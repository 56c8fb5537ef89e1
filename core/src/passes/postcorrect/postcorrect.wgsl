// Step-IV (Kim 2016, section 4): traces the listed pixels and spreads from them to differing neighbours.
// Deviation: a frontier instead of scans along rows and columns. A thread walks along differing pixels, straight
// ahead where possible, and lists those that it cannot reach for the next round. The set of traced pixels does
// not depend on the order, as comparisons are between a traced and an interpolated pixel and neither changes
// afterwards.

// Marks an entry that holds no pixel.
const NOWHERE: u32 = 0xffffffffu;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    var entry = list.pixels[index];
    // Pixels that the thread may return to, the most recent first.
    var pending = vec4u(NOWHERE);
    var heading = vec2u(0u);
    // Divides the samples of a round among the threads.
    let share = ROUND_SAMPLES / (list.end - list.begin);
    for (var steps = clamp(share, 1u, frame.part.walk); steps > 0u && entry != NOWHERE; steps -= 1u) {
        let pixel = list_pixel(entry);
        let traced = sample_trace(pixel);
        output(pixel, traced.color);
        pixel_edges_record(pixel, traced.attributes, secondary_packed(), traced.color);
        inspect_pixel(pixel, ORIGIN_POSTCORRECTED, traced.attributes);
        let identity = attributes_identity(traced.attributes.object, traced.attributes.shadow);
        var ahead = NOWHERE;
        var turn = false;
        for (var side = 0u; side < 4u; side += 1u) {
            let neighbour = postcorrect_neighbour(pixel, side);
            if !postcorrect_claim(neighbour, identity) {
                continue;
            }
            if all(neighbour - pixel == heading) {
                ahead = list_entry(neighbour);
            } else {
                postcorrect_list(pending.w);
                pending = vec4u(list_entry(neighbour), pending.xyz);
                turn = true;
            }
        }
        if ahead != NOWHERE {
            entry = ahead;
        } else {
            entry = pending.x;
            pending = vec4u(pending.yzw, NOWHERE);
            if turn {
                heading = list_pixel(entry) - pixel;
            }
        }
    }
    postcorrect_list(entry);
    for (var i = 0u; i < 4u; i += 1u) {
        postcorrect_list(pending[i]);
    }
}

fn postcorrect_list(entry: u32) {
    if entry != NOWHERE {
        list_append(list_pixel(entry));
    }
}

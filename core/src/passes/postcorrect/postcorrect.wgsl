// Step-IV (Kim 2016, section 4): traces the listed pixels and goes on from them. Deviation: a frontier instead of scans
// along rows and columns. A thread walks along what it finds, straight on where it can, and lists what it cannot come to
// for the next round. Which pixels are traced does not depend on the order: comparisons are between a traced pixel and
// what was interpolated, and neither changes any more.

// Marks an entry of the list that holds no pixel.
const NOWHERE: u32 = 0xffffffffu;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    var entry = list.pixels[index];
    // What the thread may still come back to, the latest first.
    var pending = vec4u(NOWHERE);
    var heading = vec2u(0u);
    // All threads together trace no more than a round may.
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

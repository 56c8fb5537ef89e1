// Adds the samples that fell into a pixel from the other eye to its own, in the order of their source pixels, so
// that the sum does not depend on the order of threads.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    if !COUNTS {
        stereo_gather_add(samples_place(pixel));
    }
    output(pixel, samples_mean(pixel));
}

fn stereo_gather_add(place: u32) {
    let list = atomicExchange(&samples[place].splats, 0u);
    var sum = samples_radiance(samples[place].sum);
    var count = 0u;
    var last = 0u;
    loop {
        let next = stereo_gather_next(list, last);
        if next == 0u {
            break;
        }
        sum += samples_radiance(samples[next - 1u].stereo_reuse);
        count += 1u;
        last = next;
    }
    samples[place].sum = samples_words(sum);
    if STEREO_REUSE_UNWEIGHTED {
        samples[place].second += count;
    }
}

// The smallest entry of the list that is greater than `last`; 0 if there is none.
fn stereo_gather_next(list: u32, last: u32) -> u32 {
    var least = 0u;
    var at = list;
    while at != 0u {
        if at > last && (least == 0u || at < least) {
            least = at;
        }
        at = samples[at - 1u].next;
    }
    return least;
}

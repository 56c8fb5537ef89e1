// The other eye looks at what each path has met, which decides what its sample counts for here and there. Paths meet things
// at different times; here all threads look at once.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 8u * order_tile(group, groups, ORDER_SINGLY) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let ray = eyes_ray(pixel, numbers_pair(pixel, NUMBERS_PLACE_IN_PIXEL));
    var look = Look(pixel, ray, 1u, crossing_begin());
    let place = samples_place(pixel);
    look_along(&look, samples[place].next, samples[place].second);
    inspect_more(pixel);
    if !COUNTS {
        look_send(place, look.crossing);
    }
}

// Adds the pixel's own sample and sends it over.
fn look_send(place: u32, crossing: Crossing) {
    let radiance = samples_radiance(samples[place].crossing);
    let sum = crossing.own * radiance;
    let before = samples_radiance(samples[place].sum);
    samples[place].sum = samples_words(select(sum, sum + before, frame.paths.sample > 0u));
    samples[place].crossing = samples_words(crossing.other * radiance);
    if CROSSING_COUNTS {
        samples[place].second = select(1u, samples[place].second + 1u, frame.paths.sample > 0u);
    }
    if crossing.landing != 0u {
        samples[place].next = atomicExchange(&samples[crossing.landing - 1u].landed, place + 1u);
    }
}

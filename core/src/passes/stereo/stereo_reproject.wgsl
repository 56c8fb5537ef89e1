// Tests whether the other eye sees what each path has hit, which decides the weight of the path's sample in both
// eyes. A separate pass keeps threads converged: paths hit surfaces at different times.

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 8u * tile_order(group, groups, TILE_ORDER_SINGLE) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let ray = eyes_ray(pixel, rng_pair(pixel, RNG_PLACE_IN_PIXEL));
    var reprojection = StereoReprojection(pixel, ray, 1u, stereo_reuse_begin());
    let place = samples_place(pixel);
    stereo_reproject_path(&reprojection, samples[place].next, samples[place].second);
    inspect_more(pixel);
    if !COUNTS {
        stereo_splat(place, reprojection.stereo_reuse);
    }
}

// Adds the pixel's own sample and links it into the list of the other eye's pixel.
fn stereo_splat(place: u32, stereo_reuse: StereoReuse) {
    let radiance = samples_radiance(samples[place].stereo_reuse);
    let sum = stereo_reuse.own * radiance;
    let before = samples_radiance(samples[place].sum);
    samples[place].sum = samples_words(select(sum, sum + before, frame.paths.sample > 0u));
    samples[place].stereo_reuse = samples_words(stereo_reuse.other * radiance);
    if STEREO_REUSE_UNWEIGHTED {
        samples[place].second = select(1u, samples[place].second + 1u, frame.paths.sample > 0u);
    }
    if stereo_reuse.splat != 0u {
        samples[place].next = atomicExchange(&samples[stereo_reuse.splat - 1u].splats, place + 1u);
    }
}

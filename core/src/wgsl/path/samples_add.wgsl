// Sums of path samples where each pixel has its own samples alone: added and displayed at once.

fn samples_add(pixel: vec2u, stereo_reuse: StereoReuse, radiance: vec3f) {
    if COUNTS {
        return;
    }
    var sum = radiance;
    if frame.paths.sample > 0u {
        sum += samples_load(pixel);
    }
    samples_store(pixel, sum);
    output(pixel, samples_mean(pixel));
}

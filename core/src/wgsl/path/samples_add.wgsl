// Adds a path's sample to the sum of its own pixel and writes the mean.

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

// Sums of samples with stereo reuse: each sample contributes to at most one pixel of the other eye, which links
// its contributions in a list.

struct Sample {
    // The pixel's sum: its own samples and those of the other eye.
    sum: array<f32, 3>,
    // Head of the list of contributions in this frame, and the next entry of the list that this sample is in:
    // indices + 1, 0 for none. Before the reprojection pass, `next` is the primitive that the path has hit first.
    splats: atomic<u32>,
    next: u32,
    // Before the reprojection pass, the primitive hit behind a mirror. With unweighted reuse, the number of
    // samples.
    second: u32,
    // This sample's weighted contribution to the other eye's pixel; before the reprojection pass, the sample
    // itself.
    stereo_reuse: array<f32, 3>,
}

var<storage, read_write> samples: array<Sample>;

fn samples_words(radiance: vec3f) -> array<f32, 3> {
    return array<f32, 3>(radiance.x, radiance.y, radiance.z);
}

fn samples_radiance(words: array<f32, 3>) -> vec3f {
    return vec3f(words[0], words[1], words[2]);
}

fn samples_place(pixel: vec2u) -> u32 {
    return pixel.y * frame.size.x + pixel.x;
}

fn samples_store(pixel: vec2u, radiance: vec3f) {
    samples[samples_place(pixel)].sum = samples_words(radiance);
}

fn samples_load(pixel: vec2u) -> vec3f {
    return samples_radiance(samples[samples_place(pixel)].sum);
}

// The mean of a pixel's samples.
fn samples_mean(pixel: vec2u) -> vec3f {
    let place = samples_place(pixel);
    let count = select(frame.paths.sample + 1u + frame.paths.merged, samples[place].second, STEREO_REUSE_UNWEIGHTED);
    return samples_radiance(samples[place].sum) / f32(count);
}

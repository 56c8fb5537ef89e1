// Sums of samples, and what crosses over: each sample lands in one pixel at most, whose samples are a list.

struct Sample {
    // The pixel's own sum with what has landed in it.
    sum: array<f32, 3>,
    // The first that landed here in this frame, and the next in the list that this one is in: indices + 1, 0 for none. Until
    // the other eye has looked, what the path has met first.
    splats: atomic<u32>,
    next: u32,
    // What the path has met behind a mirror; where all samples count alike, how many there are instead.
    second: u32,
    // What this pixel's sample of this frame counts for where it landed; until the other eye has looked, the sample.
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

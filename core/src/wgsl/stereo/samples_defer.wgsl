// Stores a path sample until its visibility from the other eye is known.

fn samples_add(pixel: vec2u, stereo_reuse: StereoReuse, radiance: vec3f) {
    let place = samples_place(pixel);
    samples[place].stereo_reuse = samples_words(radiance);
    samples[place].next = stereo_reuse.first;
    if !STEREO_REUSE_UNWEIGHTED {
        samples[place].second = stereo_reuse.second;
    }
}

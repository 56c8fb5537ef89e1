// Stores a path's sample until the reprojection pass weights it.

fn samples_add(pixel: vec2u, stereo_reuse: StereoReuse, radiance: vec3f) {
    let place = samples_place(pixel);
    samples[place].stereo_reuse = samples_words(radiance);
    samples[place].next = stereo_reuse.first;
    if !STEREO_REUSE_UNWEIGHTED {
        samples[place].second = stereo_reuse.second;
    }
}

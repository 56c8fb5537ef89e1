// What treats noise of paths sees of a picture.

// The mean of a pixel's samples.
fn noise_mean(pixel: vec2u) -> vec3f {
    return samples_load(pixel) / f32(frame.sample + 1u);
}

// Is there such a pixel, and does the same eye see it?
fn noise_reaches(pixel: vec2u, tap: vec2i) -> bool {
    return all(tap >= vec2i(0)) && all(tap < vec2i(frame.size)) && eye_same(pixel, vec2u(tap));
}

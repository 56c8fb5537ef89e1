// Writes radiances of samples, which are averaged to pixels later.

fn output(sample: vec2u, radiance: vec3f) {
    samples_store(sample, radiance);
}

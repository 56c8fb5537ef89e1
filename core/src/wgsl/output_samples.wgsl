// Samples that a pixel is averaged from later.

fn output(sample: vec2u, radiance: vec3f) {
    samples_store(sample, radiance);
}

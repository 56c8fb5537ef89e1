// Samples that a pixel is averaged from later.

fn output(sample: vec2u, radiance: vec3f) {
    let place = samples_place(sample);
    samples[place] = radiance.x;
    samples[place + 1u] = radiance.y;
    samples[place + 2u] = radiance.z;
}

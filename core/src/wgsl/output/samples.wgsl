// Linear radiances of a band's samples, row by row.

var<storage, read_write> samples: array<f32>;

fn samples_place(sample: vec2u) -> u32 {
    return 3u * (frame_band_row(sample.y) * frame.size.x + sample.x);
}

fn samples_store(sample: vec2u, radiance: vec3f) {
    let place = samples_place(sample);
    samples[place] = radiance.x;
    samples[place + 1u] = radiance.y;
    samples[place + 2u] = radiance.z;
}

fn samples_load(sample: vec2u) -> vec3f {
    let place = samples_place(sample);
    return vec3f(samples[place], samples[place + 1u], samples[place + 2u]);
}

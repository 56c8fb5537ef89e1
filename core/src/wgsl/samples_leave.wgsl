// Adds the pixel's own sample and sends it over.

fn samples_add(pixel: vec2u, crossing: Crossing, radiance: vec3f) {
    let place = samples_place(pixel);
    var sum = crossing.own * radiance;
    var count = 1u;
    if frame.sample > 0u {
        sum += samples_radiance(samples[place].sum);
        count += samples[place].count;
    }
    samples[place].sum = samples_words(sum);
    samples[place].count = count;
    if crossing.landing != 0u {
        samples[place].crossing = samples_words(crossing.other * radiance);
        samples[place].next = atomicExchange(&samples[crossing.landing - 1u].landed, place + 1u);
    }
}

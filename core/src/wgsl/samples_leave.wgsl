// Leaves a sample where it is until the other eye has looked.

fn samples_add(pixel: vec2u, crossing: Crossing, radiance: vec3f) {
    let place = samples_place(pixel);
    samples[place].crossing = samples_words(radiance);
    samples[place].next = crossing.first;
    if !CROSSING_COUNTS {
        samples[place].second = crossing.second;
    }
}

// Stores a path sample until its visibility from the other eye is known.

fn samples_add(pixel: vec2u, crossing: Crossing, radiance: vec3f) {
    let place = samples_place(pixel);
    samples[place].crossing = samples_words(radiance);
    samples[place].next = crossing.first;
    if !CROSSING_COUNTS {
        samples[place].second = crossing.second;
    }
}

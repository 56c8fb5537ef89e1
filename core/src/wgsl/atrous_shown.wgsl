// The last level's light, as the surface shows it.

fn atrous_result(pixel: vec2u, words: vec4u, light: vec3f) {
    output(pixel, filtered_albedo(guides[guides_place(pixel)]) * light);
}

fn atrous_unfiltered(pixel: vec2u) {
    output(pixel, samples_mean(pixel));
}

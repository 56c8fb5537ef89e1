// Result of the last a-trous level: the filtered light times the albedo is displayed.

fn atrous_result(pixel: vec2u, words: vec4u, light: vec3f) {
    output(pixel, filtered_albedo(guides[guides_place(pixel)]) * light);
}

fn atrous_unfiltered(pixel: vec2u) {
    output(pixel, samples_mean(pixel));
}

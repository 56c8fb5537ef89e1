// Result of the last a-trous level: the filtered light times the albedo is displayed.

fn atrous_result(pixel: vec2u, words: vec4u, light: vec3f) {
    output(pixel, atrous_buffer_albedo(gbuffer[gbuffer_place(pixel)]) * light);
}

fn atrous_unfiltered(pixel: vec2u) {
    output(pixel, samples_mean(pixel));
}

// Result of an a-trous level that is not the last: the filtered light is stored for the next level.

fn atrous_result(pixel: vec2u, words: vec4u, light: vec3f) {
    filtered[guides_place(pixel)] = vec4u(words.xy, filtered_light(light));
}

fn atrous_unfiltered(pixel: vec2u) {
    filtered[guides_place(pixel)] = vec4u(0u);
}

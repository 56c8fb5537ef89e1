// Result of an a-trous level that is not the last: the filtered light is stored for the next level.

fn atrous_result(pixel: vec2u, words: vec4u, light: vec3f) {
    atrous_buffer[gbuffer_place(pixel)] = vec4u(words.xy, atrous_buffer_light(light));
}

fn atrous_unfiltered(pixel: vec2u) {
    atrous_buffer[gbuffer_place(pixel)] = vec4u(0u);
}

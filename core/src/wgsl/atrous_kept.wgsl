// Another level follows.

fn atrous_result(pixel: vec2u, guide: vec4u, light: vec3f) {
    filtered_store(pixel, light);
}

fn atrous_unfiltered(pixel: vec2u) {}

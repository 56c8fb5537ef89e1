// For scenes without texture coordinates and vertex colours.

fn vertex_texcoords(primitive: u32) -> array<vec2f, 3> {
    return array<vec2f, 3>();
}

fn vertex_texcoord(hit: Hit) -> vec2f {
    return vec2f(0.0);
}

fn vertex_color(hit: Hit) -> vec3f {
    return vec3f(1.0);
}

fn vertex_alpha(hit: Hit) -> f32 {
    return 1.0;
}

// Texture coordinates and colours at a hit, if the scene has them.

fn vertex_texcoord(hit: Hit) -> vec2f {
    let corners = vertex_texcoords(hit.primitive);
    return (1.0 - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
}

fn vertex_color(hit: Hit) -> vec3f {
    return vertex_rgba(hit).rgb;
}

fn vertex_alpha(hit: Hit) -> f32 {
    return vertex_rgba(hit).a;
}

// Exactly 1 where all corners are white.
fn vertex_rgba(hit: Hit) -> vec4f {
    let corners = vertex_colors(hit.primitive);
    let words = corners[0] & corners[1] & corners[2];
    if all(words == vec2u(0xffffffffu)) {
        return vec4f(1.0);
    }
    return (1.0 - hit.u - hit.v) * vertex_unpack(corners[0]) + hit.u * vertex_unpack(corners[1])
        + hit.v * vertex_unpack(corners[2]);
}

fn vertex_unpack(words: vec2u) -> vec4f {
    return vec4f(unpack2x16unorm(words.x), unpack2x16unorm(words.y));
}

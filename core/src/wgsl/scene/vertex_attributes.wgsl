// Texture coordinates and colours at a hit, if the scene has them.

fn vertex_texcoord(hit: Hit) -> vec2f {
    let corners = vertex_texcoords(hit.primitive);
    return (1.0 - hit.u - hit.v) * corners[0] + hit.u * corners[1] + hit.v * corners[2];
}

fn vertex_color(hit: Hit) -> vec3f {
    let corners = vertex_colors(hit.primitive);
    if corners.w == 0u {
        return vec3f(1.0);
    }
    return (1.0 - hit.u - hit.v) * unpack4x8unorm(corners.x).rgb + hit.u * unpack4x8unorm(corners.y).rgb
        + hit.v * unpack4x8unorm(corners.z).rgb;
}

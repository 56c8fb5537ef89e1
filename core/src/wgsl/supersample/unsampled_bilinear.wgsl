// The centres around an inactive quarter of a pixel stand for it, bilinearly (Jin 2009, section 6).

// What bilinear interpolation adds to the pixel's colour for its inactive subpixels.
fn inactive_correction(pixel: vec2u, mask: u32) -> vec3f {
    let own = edges_color(pixel);
    var sum = vec3f(0.0);
    for (var quarter = 0u; quarter < 4u; quarter += 1u) {
        if (mask & (1u << quarter)) == 0u {
            let column = 2u * (quarter & 1u);
            let row = 3u * (quarter & 2u);
            let beside = edges_color(edges_neighbour(pixel, 3u + column)) - own;
            let above = edges_color(edges_neighbour(pixel, row + 1u)) - own;
            let across = edges_color(edges_neighbour(pixel, row + column)) - own;
            sum += (3.0 * (beside + above) + across) / 64.0;
        }
    }
    return sum;
}

fn inactive_output(pixel: vec2u, mask: u32) {
    if mask == 0u {
        output(pixel, edges_color(pixel) + inactive_correction(pixel, mask));
    }
}

// Inactive subpixels of a pixel are interpolated bilinearly between the surrounding pixel centres (Jin 2009,
// section 6).

// Change of the pixel's colour by bilinear interpolation in its inactive subpixels.
fn unsampled_correction(pixel: vec2u, mask: u32) -> vec3f {
    let own = pixel_edges_color(pixel);
    var sum = vec3f(0.0);
    for (var subpixel = 0u; subpixel < 4u; subpixel += 1u) {
        if (mask & (1u << subpixel)) == 0u {
            let column = 2u * (subpixel & 1u);
            let row = 3u * (subpixel & 2u);
            let beside = pixel_edges_color(pixel_edges_neighbour(pixel, 3u + column)) - own;
            let above = pixel_edges_color(pixel_edges_neighbour(pixel, row + 1u)) - own;
            let across = pixel_edges_color(pixel_edges_neighbour(pixel, row + column)) - own;
            sum += (3.0 * (beside + above) + across) / 64.0;
        }
    }
    return sum;
}

fn unsampled_output(pixel: vec2u, mask: u32) {
    if mask == 0u {
        output(pixel, pixel_edges_color(pixel) + unsampled_correction(pixel, mask));
    }
}

// Interpolates or lists one sample between two references, as Step-II-a and Step-III-a share it.

fn similarity_step(pixel: vec2u, a_pixel: vec2u, b_pixel: vec2u) {
    if any(b_pixel >= frame.size) {
        // At the border of a frame whose size is not a multiple of the block, a sample has one reference only.
        list_append(pixel);
        inspect_failed(pixel, 0u);
        return;
    }
    let a = attributes_load(a_pixel);
    let b = attributes_load(b_pixel);
    var failed = similarity_failed(a, a_pixel, b, b_pixel);
    if failed == 0u {
        failed = similarity_coverage_failed(a, b);
    }
    if failed != 0u {
        list_append(pixel);
        inspect_failed(pixel, failed);
        return;
    }
    let middle = similarity_interpolate(a, b);
    let color = similarity_shade(pixel, middle);
    output(pixel, color);
    attributes_keep(pixel, middle, ATTRIBUTES_INTERPOLATED);
    pixel_edges_record_interpolated(pixel, a_pixel, middle, color);
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, middle);
}

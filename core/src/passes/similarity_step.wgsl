// What Step-II-a and Step-III-a share.

struct ListOut {
    count: atomic<u32>,
    begin: u32,
    end: u32,
    padding: u32,
    pixels: array<u32>,
}

var<storage, read_write> list: ListOut;

// Lists the pixel for tracing. Deviation: packing by an atomic counter, which keeps the order within a row of
// threads, instead of by parallel scans; Step-II-b is left with the dispatch.
fn similarity_list(pixel: vec2u) {
    let place = atomicAdd(&list.count, 1u);
    list.pixels[place] = pixel.x | (pixel.y << 16u);
}

fn similarity_step(pixel: vec2u, a_pixel: vec2u, b_pixel: vec2u) {
    if any(b_pixel >= frame.size) {
        // The border of a frame whose size is not a multiple of the block has one reference only.
        similarity_list(pixel);
        inspect_failed(pixel, 0u);
        return;
    }
    let a = attributes_load(a_pixel);
    let b = attributes_load(b_pixel);
    let failed = similarity_failed(a, a_pixel, b, b_pixel);
    if failed != 0u {
        similarity_list(pixel);
        inspect_failed(pixel, failed);
        return;
    }
    let middle = similarity_interpolate(a, b);
    output(pixel, similarity_shade(pixel, middle));
    if attributes_stored(pixel) {
        attributes_store(pixel, middle);
    }
    inspect_pixel(pixel, ORIGIN_INTERPOLATED, middle);
}

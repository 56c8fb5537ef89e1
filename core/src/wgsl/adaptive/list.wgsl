// The list of pixels to trace, x | y << 16, densely packed: one queue for all steps of a band.

struct List {
    count: u32,
    // Start of the range that is traced next.
    begin: u32,
    end: u32,
    padding: u32,
    pixels: array<u32>,
}

fn list_entry(pixel: vec2u) -> u32 {
    return pixel.x | (pixel.y << 16u);
}

fn list_pixel(entry: u32) -> vec2u {
    return vec2u(entry & 0xffffu, entry >> 16u);
}

// Whether the pixel lies between the rows of its references (A2) or in their row (A1). The lowest set bit of its
// coordinates is its distance from them.
fn list_between_rows(pixel: vec2u) -> bool {
    let bits = pixel.x | pixel.y;
    return (pixel.y & bits & (~bits + 1u)) != 0u;
}

// Pixels to be traced, x | y << 16, packed densely.

struct List {
    count: u32,
    padding: u32,
    pixels: array<u32>,
}

fn list_pixel(entry: u32) -> vec2u {
    return vec2u(entry & 0xffffu, entry >> 16u);
}

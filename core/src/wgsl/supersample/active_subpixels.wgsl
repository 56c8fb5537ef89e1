// List entries of active subpixels, which get extra samples: x | y << 14 | subpixel << 28, and a flag for the
// first of its pixel, the master (Jin 2009, 4.3.2). The entries of a pixel are in one run of ACTIVE_RUN entries.

const ACTIVE_MASTER: u32 = 0x40000000u;
const ACTIVE_NONE: u32 = 0xffffffffu;
// Number of extra samples of an active subpixel.
const ACTIVE_SAMPLES: u32 = 4u;
const ACTIVE_RUN: u32 = TRACE_GROUP / ACTIVE_SAMPLES;

fn active_entry(pixel: vec2u, subpixel: u32, master: bool) -> u32 {
    return pixel.x | (pixel.y << 14u) | (subpixel << 28u) | select(0u, ACTIVE_MASTER, master);
}

fn active_pixel(entry: u32) -> vec2u {
    return vec2u(entry & 0x3fffu, (entry >> 14u) & 0x3fffu);
}

// Whether two entries belong to the same pixel.
fn active_same(a: u32, b: u32) -> bool {
    return ((a ^ b) & 0x8fffffffu) == 0u;
}

// Index of the subpixel: bit 0 is right, bit 1 is down.
fn active_subpixel(entry: u32) -> u32 {
    return (entry >> 28u) & 3u;
}

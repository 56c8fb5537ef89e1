// The list for refinement: space for an entry per step of four samples of each pixel, followed by the samples and
// sums of all pixels.

struct RefineList {
    count: atomic<u32>,
    begin: u32,
    end: u32,
    padding: u32,
    words: array<u32>,
}

var<storage, read_write> list: RefineList;

// Lists the next four samples of a pixel, after `step` steps.
fn refine_append(pixel: vec2u, step: u32) {
    let place = atomicAdd(&list.count, 1u);
    list.words[place] = pixel.x | (pixel.y << 14u) | (step << 28u);
}

fn refine_pixel(entry: u32) -> vec2u {
    return vec2u(entry & 0x3fffu, (entry >> 14u) & 0x3fffu);
}

fn refine_step(entry: u32) -> u32 {
    return entry >> 28u;
}

// The state of refined pixels: their first four samples, one in each subpixel, the sum and flags.

// Index of the sum of a pixel's samples, after the first four.
const REFINE_SUM: u32 = 4u;

fn refine_place(pixel: vec2u, index: u32) -> u32 {
    let entries = arrayLength(&list.words) / (REFINE_MOST / REFINE_STEP + REFINE_WORDS) * (REFINE_MOST / REFINE_STEP);
    return entries + REFINE_WORDS * (frame_band_row(pixel.y) * frame.size.x + pixel.x) + 3u * index;
}

fn refine_load(pixel: vec2u, index: u32) -> vec3f {
    let place = refine_place(pixel, index);
    return bitcast<vec3f>(vec3u(list.words[place], list.words[place + 1u], list.words[place + 2u]));
}

fn refine_store(pixel: vec2u, index: u32, color: vec3f) {
    let place = refine_place(pixel, index);
    let words = bitcast<vec3u>(color);
    list.words[place] = words.x;
    list.words[place + 1u] = words.y;
    list.words[place + 2u] = words.z;
}

// Index of the sample in a subpixel, among the first four; subpixels count from the upper left.
fn refine_in_subpixel(subpixel: u32) -> u32 {
    return (4u - subpixel) & 3u;
}

// State of a refined pixel: 1 + the round that listed it, whether it was traced (rounds may end before), and the
// mask of its samples.

const REFINE_ROUND: u32 = 0x7fu;
const REFINE_TRACED: u32 = 0x80u;
const REFINE_STRATA_SHIFT: u32 = 8u;

fn refine_state(pixel: vec2u) -> u32 {
    return attributes_read(pixel_edges_place(pixel, PIXEL_EDGE_ROUND));
}

fn refine_round(pixel: vec2u) -> u32 {
    return (refine_state(pixel) & REFINE_ROUND) - 1u;
}

// Claims a pixel for this thread to list in a round; true for one thread only.
fn refine_claim(pixel: vec2u, round: u32) -> bool {
    return atomicMax(&attributes[pixel_edges_place(pixel, PIXEL_EDGE_ROUND)], round + 1u) == 0u;
}

fn refine_mark(pixel: vec2u, bits: u32) {
    atomicOr(&attributes[pixel_edges_place(pixel, PIXEL_EDGE_ROUND)], bits);
}

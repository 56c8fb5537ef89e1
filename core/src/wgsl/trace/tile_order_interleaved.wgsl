// Interleaves tiles for CPUs. Their drivers assign each core a range of consecutive workgroups (lp_cs_tpool.c of
// Mesa), so a core with a cheap part of the image would wait for the others.

// Number of parts, each with tiles from the whole image. Their order is such that the first half of the parts has
// every second tile: for a power of two of cores up to this number, shares are equal.
const TILE_ORDER_PARTS: u32 = 16u;

// Number of consecutive tiles that stay together. Cheap kernels lose more by cores that share cache lines than by
// waiting.
const TILE_ORDER_SINGLE: u32 = 1u;
const TILE_ORDER_RUN: u32 = 16u;

// The tile of a workgroup. Tiles that do not fill the parts come last.
fn tile_order(group: vec3u, groups: vec3u, run: u32) -> vec2u {
    var index = group.y * groups.x + group.x;
    let part = groups.x * groups.y / (TILE_ORDER_PARTS * run) * run;
    if index < part * TILE_ORDER_PARTS {
        let place = index % part;
        let offset = reverseBits(index / part) / (0x80000000u / (TILE_ORDER_PARTS / 2u));
        index = (place / run * TILE_ORDER_PARTS + offset) * run + place % run;
    }
    return vec2u(index % groups.x, index / groups.x + frame.part.first);
}

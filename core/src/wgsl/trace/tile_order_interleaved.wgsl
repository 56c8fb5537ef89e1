// Tiles dealt out to the cores of a CPU. Its drivers give each core one range of consecutive workgroups (Mesa's
// lp_cs_tpool.c does), and a core whose part of the picture is cheap would wait for the others.

// So many parts, each of which holds tiles from everywhere, in such an order that the first half of the parts has
// every second tile: a power of two of cores up to this has equal shares.
const TILE_ORDER_PARTS: u32 = 16u;

// Tiles that stay together. Where little is computed, cores that write into the same cache lines lose more by it than
// by waiting.
const TILE_ORDER_SINGLE: u32 = 1u;
const TILE_ORDER_RUN: u32 = 16u;

// The tile of a workgroup; what does not divide into parts comes last.
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

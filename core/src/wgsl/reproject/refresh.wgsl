// Selects the pixels that a frame traces: those whose rank in their tile is among the `frame.refresh_count` ranks
// from `frame.refresh_first` on. Ranks form a Bayer matrix (1973, "An optimum method for two-level rendition of
// continuous-tone pictures"): of any 4^k consecutive ranks that start at a multiple of 4^k, each of the tile's
// 4^k squares has one.

fn refresh_pixel(rank: u32) -> vec2u {
    let at = frame_tile(reverseBits(rank % RANKS) / (0xffffffffu / RANKS + 1u));
    return vec2u(at.x ^ at.y, at.y);
}

fn refresh_rank(pixel: vec2u) -> u32 {
    let at = pixel % RANK_TILE;
    let mixed = refresh_spread(vec2u(at.x ^ at.y, at.y));
    return reverseBits(mixed.x | (mixed.y << 1u)) / (0xffffffffu / RANKS + 1u);
}

// Spreads the bits of eight-bit numbers, with a gap after each.
fn refresh_spread(random: vec2u) -> vec2u {
    var bits = (random | (random << vec2u(4u))) & vec2u(0x0f0fu);
    bits = (bits | (bits << vec2u(2u))) & vec2u(0x3333u);
    return (bits | (bits << vec2u(1u))) & vec2u(0x5555u);
}

fn refresh_is_due(pixel: vec2u) -> bool {
    return (refresh_rank(pixel) + RANKS - frame.refresh_first) % RANKS < frame.refresh_count;
}

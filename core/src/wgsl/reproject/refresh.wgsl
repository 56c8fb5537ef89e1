// Which pixels a frame traces anew: those whose rank in their tile is among frame.renewed ranks from frame.renewed_from on.
// Ranks are Bayer's (1973, "An optimum method for two-level rendition of continuous-tone pictures"): of any 4^k ranks that
// follow on a multiple of it, each square of a tile that is divided into 4^k has one.

fn refresh_pixel(rank: u32) -> vec2u {
    let at = frame_tile(reverseBits(rank % RANKS) / (0xffffffffu / RANKS + 1u));
    return vec2u(at.x ^ at.y, at.y);
}

fn refresh_rank(pixel: vec2u) -> u32 {
    let at = pixel % RANK_TILE;
    let mixed = refresh_spread(vec2u(at.x ^ at.y, at.y));
    return reverseBits(mixed.x | (mixed.y << 1u)) / (0xffffffffu / RANKS + 1u);
}

// The bits of eight-bit numbers, each with a gap behind it.
fn refresh_spread(random: vec2u) -> vec2u {
    var bits = (random | (random << vec2u(4u))) & vec2u(0x0f0fu);
    bits = (bits | (bits << vec2u(2u))) & vec2u(0x3333u);
    return (bits | (bits << vec2u(1u))) & vec2u(0x5555u);
}

fn refresh_is_due(pixel: vec2u) -> bool {
    return (refresh_rank(pixel) + RANKS - frame.refresh_first) % RANKS < frame.refresh_count;
}

// List entries of quincunx samples: 17 bits for the column, 15 for the row in the band.

fn quincunx_entry(point: vec2u) -> u32 {
    return point.x | (point.y << 17u);
}

fn quincunx_point(entry: u32) -> vec2u {
    return vec2u(entry & 0x1ffffu, entry >> 17u);
}

// What both parts of the postcorrection share: a traced pixel and its four neighbours.

// An identity that no pixel has.
const NO_IDENTITY: vec2u = vec2u(0xffffffffu);

// Claims a neighbour inside the band whose identity differs, so that one thread alone traces it.
fn postcorrect_claim(pixel: vec2u, unlike: vec2u) -> bool {
    let inside = pixel.x < frame.size.x && pixel.y >= frame.part.row && pixel.y < frame.part.end;
    if !inside || !attributes_claim(pixel, unlike) {
        return false;
    }
    inspect_claimed();
    return true;
}

// The neighbour on a side, 0 to 3; beyond the left and the upper border that is the largest number there is.
fn postcorrect_neighbour(pixel: vec2u, side: u32) -> vec2u {
    let step = 1u - (side & 2u);
    return pixel + select(vec2u(step, 0u), vec2u(0u, step), (side & 1u) != 0u);
}

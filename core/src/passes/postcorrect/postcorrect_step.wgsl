// Neighbours of a traced pixel and their claims, shared by the kernels of postcorrection.

// An identity that no pixel has.
const NO_IDENTITY: vec2u = vec2u(0xffffffffu);

// Claims a neighbour inside the band whose identity differs, so that exactly one thread traces it.
fn postcorrect_claim(pixel: vec2u, unlike: vec2u) -> bool {
    let inside = pixel.x < frame.size.x && pixel.y >= frame.part.row && pixel.y < frame.part.end;
    if !inside || !attributes_claim(pixel, unlike) {
        return false;
    }
    inspect_claimed();
    return true;
}

// The neighbour on side 0 to 3. Beyond the left and the upper border a coordinate wraps around to the largest
// u32.
fn postcorrect_neighbour(pixel: vec2u, side: u32) -> vec2u {
    let step = 1u - (side & 2u);
    return pixel + select(vec2u(step, 0u), vec2u(0u, step), (side & 1u) != 0u);
}

// Samples lie in the centre of their cells.

fn jitter_in(cell: vec2u) -> vec2f {
    return vec2f(0.5);
}

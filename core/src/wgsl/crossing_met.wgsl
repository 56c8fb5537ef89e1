// What the other eye is to look at: primitives + 1, 0 for none.

struct Crossing {
    first: u32,
    // Behind a mirror.
    second: u32,
}

fn crossing_begin() -> Crossing {
    return Crossing(0u, 0u);
}

fn crossing_meet(path: ptr<function, Path>, primitive: u32) {
    if (*path).level == 1u {
        (*path).crossing.first = primitive + 1u;
    }
    if (*path).level == 2u && (*path).kind == RAY_REFLECTION {
        (*path).crossing.second = primitive + 1u;
    }
}

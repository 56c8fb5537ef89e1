// The surfaces of a path that the other eye is tested against: 1 + index of the primitive, 0 for none.

struct Crossing {
    first: u32,
    // The primitive seen by way of a plane mirror.
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

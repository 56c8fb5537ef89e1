// For frames without reuse between the eyes: a sample counts in its own pixel alone.

struct Crossing {
    nothing: u32,
}

fn crossing_begin() -> Crossing {
    return Crossing(0u);
}

fn crossing_meet(path: ptr<function, Path>, primitive: u32) {}

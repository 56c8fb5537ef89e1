// Each eye for itself.

struct Crossing {
    nothing: u32,
}

fn crossing_begin() -> Crossing {
    return Crossing(0u);
}

fn crossing_meet(path: ptr<function, Path>, primitive: u32) {}

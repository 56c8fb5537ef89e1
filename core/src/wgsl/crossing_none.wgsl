// Each eye for itself.

struct Crossing {
    // What a sample counts for in its own pixel.
    own: f32,
}

fn crossing_begin() -> Crossing {
    return Crossing(1.0);
}

fn crossing_at(path: ptr<function, Path>, s: Surface, m: Material, lobes: Lobes) {}

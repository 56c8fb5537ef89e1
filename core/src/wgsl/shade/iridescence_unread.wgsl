// For scenes of extended materials without thin films.

struct Iridescence {
    nothing: u32,
}

fn iridescence_at(record: u32, at: Lookup, maps: Maps) -> Iridescence {
    return Iridescence(0u);
}

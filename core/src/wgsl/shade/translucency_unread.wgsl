// For scenes of extended materials without diffuse transmission.

struct Translucency {
    nothing: u32,
}

fn translucency_at(record: u32, at: Lookup, maps: Maps) -> Translucency {
    return Translucency(0u);
}

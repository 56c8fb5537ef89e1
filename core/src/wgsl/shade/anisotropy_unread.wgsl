// For scenes of extended materials without anisotropic lobes.

struct Anisotropy {
    nothing: u32,
}

fn anisotropy_at(record: u32, at: Lookup, maps: Maps) -> Anisotropy {
    return Anisotropy(0u);
}

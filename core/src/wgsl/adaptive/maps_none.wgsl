// For scenes without normal maps and without textures that have coordinates of their own.

struct Maps {
    nothing: u32,
}

fn maps_interpolate(a: Maps, b: Maps, a_weight: f32) -> Maps {
    return a;
}

fn maps_pack(maps: Maps) -> MapsWords {
    return MapsWords();
}

fn maps_unpack(words: MapsWords) -> Maps {
    return Maps(0u);
}

// What normal maps, anisotropic lobes and textures with coordinates of their own need of a surface: tangents and both sets of texture
// coordinates, as attributes that are stored and interpolated.

struct Maps {
    // Unit tangent on the viewer's side, and the sign of the bitangent.
    tangent: vec4f,
    // The first set of texture coordinates, not wrapped.
    first: vec2f,
    second: vec2f,
    // Second moments of the footprint in the second set.
    second_footprint: vec3f,
}

fn maps_interpolate(a: Maps, b: Maps, a_weight: f32) -> Maps {
    var middle = a;
    let b_weight = 1.0 - a_weight;
    if HAS_TANGENTS {
        let tangent = a_weight * a.tangent.xyz + b_weight * b.tangent.xyz;
        middle.tangent = vec4f(tangent * inverseSqrt(max(dot(tangent, tangent), 1.0e-12)), a.tangent.w);
    }
    if HAS_SLOT_COORDINATES {
        middle.first = a_weight * a.first + b_weight * b.first;
        middle.second = a_weight * a.second + b_weight * b.second;
        let footprint = attributes_footprint(a.second_footprint) + attributes_footprint(b.second_footprint);
        middle.second_footprint = attributes_moments(0.5 * footprint);
    }
    return middle;
}

fn maps_pack(maps: Maps) -> MapsWords {
    let footprint = footprint_encode(attributes_footprint(maps.second_footprint));
    return MapsWords(maps_tangent_encode(maps.tangent), bitcast<vec4u>(vec4f(maps.first, maps.second)), footprint);
}

fn maps_unpack(words: MapsWords) -> Maps {
    var maps: Maps;
    if HAS_TANGENTS {
        maps.tangent = maps_tangent_decode(words.tangent);
    }
    if HAS_SLOT_COORDINATES {
        let coordinates = bitcast<vec4f>(words.coordinates);
        maps.first = coordinates.xy;
        maps.second = coordinates.zw;
        maps.second_footprint = attributes_moments(footprint_decode(words.footprint));
    }
    return maps;
}

// A tangent in the octahedral encoding, whose lowest bit is set if the bitangent's sign is negative.
fn maps_tangent_encode(tangent: vec4f) -> u32 {
    return (octahedral_encode(tangent.xyz) & 0xfffffffeu) | select(0u, 1u, tangent.w < 0.0);
}

fn maps_tangent_decode(word: u32) -> vec4f {
    return vec4f(octahedral_decode(word & 0xfffffffeu), select(1.0, -1.0, (word & 1u) != 0u));
}

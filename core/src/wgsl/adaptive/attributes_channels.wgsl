// Access to the attribute planes for the adaptive steps.

var<storage, read_write> attributes: array<u32>;

fn attributes_read(place: u32) -> u32 {
    return attributes[place];
}

fn attributes_write(place: u32, word: u32) {
    attributes[place] = word;
}

// Stores the attributes that later steps refer to.
fn attributes_keep(pixel: vec2u, a: Attributes, traced: u32) {
    if attributes_stored(pixel) {
        attributes_store(pixel, a, traced);
    } else if HAS_POSTCORRECTION {
        attributes_store_object(pixel, a, traced);
    }
}

fn attributes_store_object(pixel: vec2u, a: Attributes, traced: u32) {
    let flags = traced | select(0u, ATTRIBUTES_MIRROR, a.mirrors_environment);
    if !HAS_SHADOW_WORD {
        attributes[attributes_object(pixel)] = a.object | (a.shadow << SHADOW_SHIFT) | flags;
    } else {
        attributes[attributes_object(pixel)] = a.object | flags;
        attributes[attributes_shadow(pixel)] = a.shadow;
    }
}

fn attributes_store(pixel: vec2u, a: Attributes, traced: u32) {
    attributes[attributes_channel(CHANNEL_DEPTH, pixel)] = bitcast<u32>(a.depth);
    attributes_store_object(pixel, a, traced);
    attributes[attributes_channel(CHANNEL_NORMAL, pixel)] = octahedral_encode(a.normal);
    if HAS_FACE {
        attributes[attributes_channel(CHANNEL_FACE, pixel)] = octahedral_encode(a.face);
    }
    if HAS_GCOL {
        attributes[attributes_channel(CHANNEL_GCOL, pixel)] = rgb9e5_encode(a.gcol);
    }
    if HAS_TEXTURES {
        attributes[attributes_channel(CHANNEL_TEXCOORD, pixel)] = pack2x16unorm(a.texcoord);
    }
    if HAS_COLORS {
        attributes[attributes_channel(CHANNEL_COLOR, pixel)] = pack2x16unorm(a.color.rg);
        attributes[attributes_channel(CHANNEL_COLOR_BLUE, pixel)] = pack2x16unorm(vec2f(a.color.b, a.alpha));
    }
    if HAS_FOOTPRINT {
        attributes[attributes_channel(CHANNEL_FOOTPRINT, pixel)] = footprint_encode(a.footprint);
    }
    let words = maps_pack(a.maps);
    if HAS_TANGENTS {
        attributes[attributes_channel(CHANNEL_TANGENT, pixel)] = words.tangent;
    }
    if HAS_SLOT_COORDINATES {
        attributes[attributes_channel(CHANNEL_FIRST_S, pixel)] = words.coordinates.x;
        attributes[attributes_channel(CHANNEL_FIRST_T, pixel)] = words.coordinates.y;
        attributes[attributes_channel(CHANNEL_SECOND_S, pixel)] = words.coordinates.z;
        attributes[attributes_channel(CHANNEL_SECOND_T, pixel)] = words.coordinates.w;
        attributes[attributes_channel(CHANNEL_SECOND_FOOTPRINT, pixel)] = words.footprint;
    }
}

fn attributes_load(pixel: vec2u) -> Attributes {
    var a: Attributes;
    a.depth = bitcast<f32>(attributes[attributes_channel(CHANNEL_DEPTH, pixel)]);
    let word = attributes[attributes_channel(CHANNEL_OBJECT, pixel)];
    let object = word & ~ATTRIBUTES_FLAGS;
    a.mirrors_environment = (word & ATTRIBUTES_MIRROR) != 0u;
    if !HAS_SHADOW_WORD {
        a.object = object & OBJECT_MASK;
        a.shadow = object >> SHADOW_SHIFT;
    } else {
        a.object = object;
        a.shadow = attributes[attributes_channel(CHANNEL_SHADOW, pixel)];
    }
    a.normal = octahedral_decode(attributes[attributes_channel(CHANNEL_NORMAL, pixel)]);
    a.face = a.normal;
    if HAS_FACE {
        a.face = octahedral_decode(attributes[attributes_channel(CHANNEL_FACE, pixel)]);
    }
    a.color = vec3f(1.0);
    a.alpha = 1.0;
    if HAS_GCOL {
        a.gcol = rgb9e5_decode(attributes[attributes_channel(CHANNEL_GCOL, pixel)]);
    }
    if HAS_TEXTURES {
        a.texcoord = unpack2x16unorm(attributes[attributes_channel(CHANNEL_TEXCOORD, pixel)]);
    }
    if HAS_COLORS {
        let blue = unpack2x16unorm(attributes[attributes_channel(CHANNEL_COLOR_BLUE, pixel)]);
        a.color = vec3f(unpack2x16unorm(attributes[attributes_channel(CHANNEL_COLOR, pixel)]), blue.x);
        a.alpha = blue.y;
    }
    if HAS_FOOTPRINT {
        a.footprint = footprint_decode(attributes[attributes_channel(CHANNEL_FOOTPRINT, pixel)]);
    }
    var words: MapsWords;
    if HAS_TANGENTS {
        words.tangent = attributes[attributes_channel(CHANNEL_TANGENT, pixel)];
    }
    if HAS_SLOT_COORDINATES {
        words.coordinates = vec4u(
            attributes[attributes_channel(CHANNEL_FIRST_S, pixel)],
            attributes[attributes_channel(CHANNEL_FIRST_T, pixel)],
            attributes[attributes_channel(CHANNEL_SECOND_S, pixel)],
            attributes[attributes_channel(CHANNEL_SECOND_T, pixel)],
        );
        words.footprint = attributes[attributes_channel(CHANNEL_SECOND_FOOTPRINT, pixel)];
    }
    a.maps = maps_unpack(words);
    return a;
}

// Encodes three radiances with a shared exponent and nine bits each; the error is at most 2^-9 of the largest.
fn rgb9e5_encode(color: vec3f) -> u32 {
    let clamped = clamp(color, vec3f(0.0), vec3f(65408.0));
    let largest = max(clamped.x, max(clamped.y, clamped.z));
    // floor(log2(largest)), read from the exponent's bits; at least -16.
    var exponent = max(i32(bitcast<u32>(largest) >> 23u) - 127, -16) + 1;
    var scale = bitcast<f32>(u32(9 - exponent + 127) << 23u);
    if round(largest * scale) > 511.0 {
        exponent += 1;
        scale *= 0.5;
    }
    let mantissa = vec3u(round(clamped * scale));
    return mantissa.x | (mantissa.y << 9u) | (mantissa.z << 18u) | (u32(exponent + 15) << 27u);
}

fn rgb9e5_decode(packed: u32) -> vec3f {
    let scale = bitcast<f32>(((packed >> 27u) + 127u - 24u) << 23u);
    return vec3f(vec3u(packed & 511u, (packed >> 9u) & 511u, (packed >> 18u) & 511u)) * scale;
}

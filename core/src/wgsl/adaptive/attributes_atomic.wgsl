// Access to the attribute planes for postcorrection: exactly one thread claims a pixel for tracing.

var<storage, read_write> attributes: array<atomic<u32>>;

fn attributes_read(place: u32) -> u32 {
    return atomicLoad(&attributes[place]);
}

fn attributes_write(place: u32, word: u32) {
    atomicStore(&attributes[place], word);
}

// The identity that postcorrection compares: OID, and SHDBIT if the settings include it.
fn attributes_identity(object: u32, shadow: u32) -> vec2u {
    return vec2u(object, select(0u, shadow, COMPARES_SHADOWS));
}

fn attributes_stored_identity(pixel: vec2u, word: u32) -> vec2u {
    let bits = word & ~ATTRIBUTES_FLAGS;
    if !HAS_SHADOW_WORD {
        return attributes_identity(bits & OBJECT_MASK, bits >> SHADOW_SHIFT);
    }
    return attributes_identity(bits, atomicLoad(&attributes[attributes_shadow(pixel)]));
}

fn attributes_load_identity(pixel: vec2u) -> vec2u {
    return attributes_stored_identity(pixel, atomicLoad(&attributes[attributes_object(pixel)]));
}

// Claims the pixel if it was interpolated and its identity differs; true for one thread only.
fn attributes_claim(pixel: vec2u, unlike: vec2u) -> bool {
    let place = attributes_object(pixel);
    let word = atomicLoad(&attributes[place]);
    if (word & ATTRIBUTES_TRACED) != 0u || all(attributes_stored_identity(pixel, word) == unlike) {
        return false;
    }
    return (atomicOr(&attributes[place], ATTRIBUTES_TRACED) & ATTRIBUTES_TRACED) == 0u;
}

fn attributes_traced(pixel: vec2u) -> bool {
    return (atomicLoad(&attributes[attributes_object(pixel)]) & ATTRIBUTES_TRACED) != 0u;
}

// Stores the identity for neighbours that compare with the pixel later; no one reads the other attributes any
// more.
fn attributes_store_identity(pixel: vec2u, a: Attributes) {
    var word = a.object | ATTRIBUTES_TRACED;
    if !HAS_SHADOW_WORD {
        word |= a.shadow << SHADOW_SHIFT;
    } else {
        atomicStore(&attributes[attributes_shadow(pixel)], a.shadow);
    }
    atomicStore(&attributes[attributes_object(pixel)], word);
}

// The ray-attribute vector of a pixel (Kim 2016, section 3.2): OID, POS, NORM, SHDBIT, TCOORD, GCOL, and the face
// normal where shading normals differ from it.
// Stored as planes of 32-bit words for every second row of the band, the only ones that other pixels refer to.
// POS is the depth along the pixel's own ray; SHDBIT shares a word with OID if both fit. Postcorrection needs
// OID, SHDBIT and the traced flag of every row, so these planes exist once more for the rows between.

struct Attributes {
    depth: f32,
    // OID + 1, or 0 if the ray hits nothing.
    object: u32,
    normal: vec3f,
    face: vec3f,
    shadow: u32,
    // Whether GCOL is that of one mirrored ray, which met nothing.
    mirrors_environment: bool,
    gcol: vec3f,
    texcoord: vec2f,
    color: vec3f,
    // Alpha of the vertices.
    alpha: f32,
    // Footprint in texture coordinates: log2 of the second moments along s and t, and their correlation.
    footprint: vec3f,
    maps: Maps,
}

// The stored words of Maps.
struct MapsWords {
    tangent: u32,
    coordinates: vec4u,
    footprint: u32,
}

// Converts second moments to a footprint attribute; linear interpolation of it gives the geometric mean.
fn attributes_footprint(moments: vec3f) -> vec3f {
    let lengths = clamp(moments.xy, vec2f(exp2(FOOTPRINT_LEAST)), vec2f(exp2(FOOTPRINT_MOST)));
    return vec3f(log2(lengths), clamp(moments.z * inverseSqrt(lengths.x * lengths.y), -1.0, 1.0));
}

fn attributes_moments(footprint: vec3f) -> vec3f {
    let lengths = exp2(footprint.xy);
    return vec3f(lengths, footprint.z * sqrt(lengths.x * lengths.y));
}

// Encodes a footprint: eleven bits for each logarithm and ten for the correlation, with an exact zero.
fn footprint_encode(footprint: vec3f) -> u32 {
    let share = (footprint.xy - FOOTPRINT_LEAST) / (FOOTPRINT_MOST - FOOTPRINT_LEAST);
    let lengths = vec2u(round(2047.0 * clamp(share, vec2f(0.0), vec2f(1.0))));
    return lengths.x | (lengths.y << 11u) | (u32(round(511.0 * footprint.z) + 511.0) << 22u);
}

fn footprint_decode(packed: u32) -> vec3f {
    let share = vec2f(vec2u(packed & 2047u, (packed >> 11u) & 2047u)) / 2047.0;
    let lengths = FOOTPRINT_LEAST + (FOOTPRINT_MOST - FOOTPRINT_LEAST) * share;
    return vec3f(lengths, f32(packed >> 22u) / 511.0 - 1.0);
}

// Flag in the word of OID, above its bits: the pixel was traced.
const ATTRIBUTES_TRACED: u32 = 0x80000000u;
const ATTRIBUTES_INTERPOLATED: u32 = 0u;
const ATTRIBUTES_FLAGS: u32 = ATTRIBUTES_TRACED | ATTRIBUTES_MIRROR;

fn attributes_channel(plane: u32, pixel: vec2u) -> u32 {
    return (frame_band_row(pixel.y) / 2u * CHANNELS + plane) * frame.size.x + pixel.x;
}

// Whether a later step interpolates from the pixel, so that its attributes must be stored.
fn attributes_stored(pixel: vec2u) -> bool {
    return pixel.y % 2u == 0u;
}

// Index of the pixel's OID in the attribute buffer.
fn attributes_object(pixel: vec2u) -> u32 {
    return attributes_channel(select(CHANNEL_OBJECT_BETWEEN, CHANNEL_OBJECT, attributes_stored(pixel)), pixel);
}

// Index of the pixel's SHDBIT, unless it shares the word of OID.
fn attributes_shadow(pixel: vec2u) -> u32 {
    return attributes_channel(select(CHANNEL_SHADOW_BETWEEN, CHANNEL_SHADOW, attributes_stored(pixel)), pixel);
}

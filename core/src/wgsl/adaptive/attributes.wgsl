// The ray-attribute vector of a pixel (Kim 2016, section 3.2): OID, POS, NORM, SHDBIT, TCOORD, GCOL; and beside them
// the normal of the face, where shading normals differ from it.
// Stored as planes of 32 bits, for every second row of the band alone, which are all that others refer to; POS as the
// depth along the pixel's own ray, SHDBIT above OID where both fit into one word. Postcorrection refers to OID and SHDBIT
// of every row, and to whether a pixel was traced: these planes are there once more, for the rows between.

struct Attributes {
    depth: f32,
    // OID + 1, 0 where the ray meets nothing.
    object: u32,
    normal: vec3f,
    face: vec3f,
    shadow: u32,
    gcol: vec3f,
    texcoord: vec2f,
    color: vec3f,
    // What the pixel covers of textures: log2 of the second moments along s and along t, and their correlation.
    footprint: vec3f,
}

// A footprint as an attribute: half way between two of them lies the geometric mean.
fn attributes_footprint(moments: vec3f) -> vec3f {
    let lengths = clamp(moments.xy, vec2f(exp2(FOOTPRINT_LEAST)), vec2f(exp2(FOOTPRINT_MOST)));
    return vec3f(log2(lengths), clamp(moments.z * inverseSqrt(lengths.x * lengths.y), -1.0, 1.0));
}

fn attributes_moments(footprint: vec3f) -> vec3f {
    let lengths = exp2(footprint.xy);
    return vec3f(lengths, footprint.z * sqrt(lengths.x * lengths.y));
}

// In the word of OID, whose bits end below it: the pixel was traced.
const ATTRIBUTES_TRACED: u32 = 0x80000000u;
const ATTRIBUTES_INTERPOLATED: u32 = 0u;

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

// Where SHDBIT is, unless it is in one word with OID.
fn attributes_shadow(pixel: vec2u) -> u32 {
    return attributes_channel(select(CHANNEL_SHADOW_BETWEEN, CHANNEL_SHADOW, attributes_stored(pixel)), pixel);
}

// Pixels as the a-trous filter sees them, four words each: normal, mean albedo and kind of guide, of 8 bits a component; how
// far along the primary ray, 0 for pixels that are not filtered; and the light, what arrives at the first diffuse surface
// over pi: its channels' sum, and the shares of two of them, which add up without being unpacked.

var<storage, read_write> filtered: array<vec4u>;
var<storage, read> filtered_before: array<vec4u>;

// Surfaces are taken for no darker: what a black one shows remains.
const FILTERED_LEAST_ALBEDO: f32 = 0.01;
// Light below this counts as black.
const FILTERED_BLACK: f32 = 1.0e-20;
// Quantisation steps of the mean albedo.
const FILTERED_ALBEDO: f32 = 127.0;

const FILTERED_MIRRORED: u32 = 0x80000000u;

fn filtered_albedo(guide: vec4u) -> vec3f {
    return max(guides_albedo(guide), vec3f(FILTERED_LEAST_ALBEDO));
}

fn filtered_sum(channels: vec3f) -> f32 {
    return channels.x + channels.y + channels.z;
}

// Packs normal, mean albedo, kind and depth of the first diffuse surface into two words.
fn filtered_guide(guide: vec4u) -> vec2u {
    let normal = pack4x8snorm(vec4f(octahedral_decode(guide.x), 0.0));
    let albedo = u32(round(FILTERED_ALBEDO / 3.0 * filtered_sum(guides_albedo(guide))));
    let kind = select(0u, FILTERED_MIRRORED, guides_kind(guide) == GUIDE_MIRRORED);
    return vec2u(normal | albedo << 24u | kind, guide.y);
}

// Packs the light into two words.
fn filtered_light(light: vec3f) -> vec2u {
    let sum = filtered_sum(light);
    return vec2u(bitcast<u32>(sum), pack2x16unorm(light.xy / max(sum, FILTERED_BLACK)));
}

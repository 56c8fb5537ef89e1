// Pixels of the a-trous filter, four words each: normal, mean albedo and kind of guide in 8 bits per component;
// distance along the primary ray, 0 for pixels that are not filtered; and the light, which is the irradiance at
// the first diffuse surface over pi: the sum of its channels and the shares of two of them.

var<storage, read_write> atrous_buffer: array<vec4u>;
var<storage, read> atrous_buffer_before: array<vec4u>;

// Least albedo to divide by, so that light from black surfaces stays finite.
const ATROUS_BUFFER_LEAST_ALBEDO: f32 = 0.01;
// Light below this counts as black.
const ATROUS_BUFFER_BLACK: f32 = 1.0e-20;
// Quantisation steps of the mean albedo.
const ATROUS_BUFFER_ALBEDO: f32 = 127.0;

const ATROUS_BUFFER_MIRRORED: u32 = 0x80000000u;

fn atrous_buffer_albedo(gbuffer_pixel: vec4u) -> vec3f {
    return max(gbuffer_albedo(gbuffer_pixel), vec3f(ATROUS_BUFFER_LEAST_ALBEDO));
}

fn atrous_buffer_sum(channels: vec3f) -> f32 {
    return channels.x + channels.y + channels.z;
}

// Packs normal, mean albedo, kind and depth of the first diffuse surface into two words.
fn atrous_buffer_guide(gbuffer_pixel: vec4u) -> vec2u {
    let normal = pack4x8snorm(vec4f(octahedral_decode(gbuffer_pixel.x), 0.0));
    let albedo = u32(round(ATROUS_BUFFER_ALBEDO / 3.0 * atrous_buffer_sum(gbuffer_albedo(gbuffer_pixel))));
    let kind = select(0u, ATROUS_BUFFER_MIRRORED, gbuffer_kind(gbuffer_pixel) == GBUFFER_MIRRORED);
    return vec2u(normal | albedo << 24u | kind, gbuffer_pixel.y);
}

// Packs the light into two words.
fn atrous_buffer_light(light: vec3f) -> vec2u {
    let sum = atrous_buffer_sum(light);
    return vec2u(bitcast<u32>(sum), pack2x16unorm(light.xy / max(sum, ATROUS_BUFFER_BLACK)));
}

// The light that is filtered: what arrives at the first diffuse surface, over pi.

var<storage, read_write> filtered: array<f32>;
var<storage, read> filtered_before: array<f32>;

// Surfaces are taken for no darker: what a black one shows remains.
const FILTERED_LEAST_ALBEDO: f32 = 0.01;

const FILTERED_LUMINANCE: vec3f = vec3f(0.2126, 0.7152, 0.0722);

fn filtered_store(pixel: vec2u, light: vec3f) {
    let place = samples_place(pixel);
    filtered[place] = light.x;
    filtered[place + 1u] = light.y;
    filtered[place + 2u] = light.z;
}

fn filtered_load(pixel: vec2u) -> vec3f {
    let place = samples_place(pixel);
    return vec3f(filtered_before[place], filtered_before[place + 1u], filtered_before[place + 2u]);
}

fn filtered_albedo(guide: vec4u) -> vec3f {
    return max(guides_albedo(guide), vec3f(FILTERED_LEAST_ALBEDO));
}

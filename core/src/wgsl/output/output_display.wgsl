// Writes the displayed frame: sRGB-encoded, 8 bits a channel.

var display: texture_storage_2d<rgba8unorm, write>;

fn output(pixel: vec2u, radiance: vec3f) {
    let c = clamp(tone_mapped(radiance), vec3f(0.0), vec3f(1.0));
    let encoded = select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
    textureStore(display, pixel, vec4f(encoded, 1.0));
}

// Writes linear radiance, 32-bit floating point.

var linear: texture_storage_2d<rgba32float, write>;

fn output(pixel: vec2u, radiance: vec3f) {
    textureStore(linear, pixel, vec4f(radiance, 1.0));
}

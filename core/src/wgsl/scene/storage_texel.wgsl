// What kernels read at any place lies in images on CPUs: lavapipe reads texels for a vector at once, words of a buffer lane by
// lane, each behind branches of its own.

fn texel(index: u32) -> vec2u {
    return vec2u(index % TEXEL_ROW, index / TEXEL_ROW);
}

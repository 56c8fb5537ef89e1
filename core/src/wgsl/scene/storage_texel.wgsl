// What kernels read at any place lies in images on CPUs: lavapipe reads texels for a vector at once, words of a buffer lane by
// lane, each behind branches of its own.

fn storage_texel(index: u32) -> vec2u {
    return vec2u(index % STORAGE_TEXTURE_WIDTH, index / STORAGE_TEXTURE_WIDTH);
}

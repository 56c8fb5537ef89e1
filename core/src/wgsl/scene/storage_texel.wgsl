// Reads randomly accessed data from images, for CPUs: lavapipe fetches texels for a whole vector, but words of a
// buffer lane by lane with a branch for each.

fn storage_texel(index: u32) -> vec2u {
    return vec2u(index % STORAGE_TEXTURE_WIDTH, index / STORAGE_TEXTURE_WIDTH);
}

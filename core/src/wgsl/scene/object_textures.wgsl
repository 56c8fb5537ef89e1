// The objects in an image, for CPUs: seven texels each.

var objects: texture_2d<u32>;

fn object_part(object: u32, part: u32) -> vec4u {
    return textureLoad(objects, storage_texel(7u * object + part), 0);
}

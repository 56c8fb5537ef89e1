// The objects in a buffer, for GPUs: seven times four words each.

var<storage, read> objects: array<vec4u>;

fn object_part(object: u32, part: u32) -> vec4u {
    return objects[7u * object + part];
}

// The objects in a buffer, as GPUs read it.

var<storage, read> objects: array<Object>;

fn object_at(object: u32) -> Object {
    return objects[object];
}

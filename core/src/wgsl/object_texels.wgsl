// The objects in an image, as CPUs read it: seven texels each.

var objects: texture_2d<u32>;

fn object_at(object: u32) -> Object {
    let base = object_part(object, 0u);
    let emission = object_part(object, 1u);
    let surface = bitcast<vec4f>(object_part(object, 2u));
    let weights = object_part(object, 3u);
    return Object(
        bitcast<vec3f>(base.xyz), bitcast<f32>(base.w),
        bitcast<vec3f>(emission.xyz), bitcast<f32>(emission.w),
        surface.x, surface.y, surface.z, surface.w,
        bitcast<vec3f>(weights.xyz), weights.w,
        object_part(object, 4u), object_part(object, 5u), object_part(object, 6u),
    );
}

fn object_part(object: u32, part: u32) -> vec4u {
    return textureLoad(objects, texel(7u * object + part), 0);
}

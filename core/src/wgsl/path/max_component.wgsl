// The largest component of an RGB weight, which decides whether a ray is traced.

fn max_component(share: vec3f) -> f32 {
    return max(share.x, max(share.y, share.z));
}

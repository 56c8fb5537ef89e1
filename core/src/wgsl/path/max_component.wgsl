// Measures of an RGB weight that decide about following a ray.

fn max_component(share: vec3f) -> f32 {
    return max(share.x, max(share.y, share.z));
}

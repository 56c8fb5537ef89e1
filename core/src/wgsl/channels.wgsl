// What a share of light is judged by.

fn channels_largest(share: vec3f) -> f32 {
    return max(share.x, max(share.y, share.z));
}

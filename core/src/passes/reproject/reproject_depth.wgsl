// Reprojection: projects every point of the last frame into the current view and keeps each pixel's nearest
// depth.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(pixel >= frame.size) || !reproject_is_needed() {
        return;
    }
    let moved = reproject_point(pixel);
    if moved.key != 0u {
        atomicMax(&splats[moved.to].key, moved.key);
    }
}

// Reprojection: finds the pixel that the nearest point came from, of equal ones the first, so that frames are
// reproducible. Where a compiler rounds a key differently here there is none, and the pixel is traced.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let pixel = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(pixel >= frame.size) || !reproject_is_needed() {
        return;
    }
    let moved = reproject_point(pixel);
    if moved.key != 0u && atomicLoad(&splats[moved.to].key) == moved.key {
        atomicMax(&splats[moved.to].source, ~(pixel.y * frame.size.x + pixel.x));
    }
}

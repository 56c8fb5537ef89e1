// Step-IV, beyond the paper: small things may lie between the samples as a whole, and no traced pixel has them for a
// neighbour. Where a point that is known of one would be seen, it is looked for.

// Points on thin objects, in world space.
var<storage, read> probe_points: array<f32>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let first = 3u * (group.x * TRACE_GROUP + local);
    if first >= arrayLength(&probe_points) {
        return;
    }
    let at = frame_place(vec3f(probe_points[first], probe_points[first + 1u], probe_points[first + 2u]));
    if !(all(at >= vec2f(0.0)) && all(at < vec2f(frame.size))) {
        return;
    }
    let pixel = vec2u(at);
    if postcorrect_claim(pixel, NO_IDENTITY) {
        list_append(pixel);
    }
}

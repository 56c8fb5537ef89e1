// Step-IV, beyond the paper: small objects may lie entirely between samples, so that no traced pixel borders on
// them. Lists the interpolated pixels onto which known points of such objects project.

// Points on thin objects, in world space: three words each.
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

// Lists the samples of the quarters of pixels that are divided.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(at >= 2u * vec2u(frame.size.x, frame.part.end - frame.part.row)) {
        return;
    }
    let pixel = at / 2u;
    let inside = at % 2u;
    let q = quincunx_quad(pixel, inside.x + 2u * inside.y);
    if quincunx_differs(q) {
        quincunx_split(q);
    }
}

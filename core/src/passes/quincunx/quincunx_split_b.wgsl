// Lists the samples of the quarters of divided quarters that are divided again.

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    if any(at >= 4u * vec2u(frame.size.x, frame.part.end - frame.part.row)) {
        return;
    }
    let pixel = at / 4u;
    let subpixel = at / 2u % 2u;
    let q = quincunx_quad(pixel, subpixel.x + 2u * subpixel.y);
    if !quincunx_differs(q) {
        return;
    }
    let inside = at % 2u;
    let part = quincunx_part(q, inside.x + 2u * inside.y);
    if quincunx_differs(part) {
        quincunx_split(part);
    }
}

// Averages a pixel's samples, weighted by the area that each represents (lecture, "Adaptive supersampling (3)").

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x || pixel.y >= frame.part.end {
        return;
    }
    let center = quincunx_load(8u * at + 4u);
    var split = 0u;
    // Sums differences from the centre: equal samples then have exactly that mean.
    var sum = vec3f(0.0);
    for (var subpixel = 0u; subpixel < 4u; subpixel += 1u) {
        let q = quincunx_quad(at, subpixel);
        if !quincunx_differs(q) {
            sum += quincunx_mean(q, center) / 4.0;
            continue;
        }
        split |= 1u << subpixel;
        for (var i = 0u; i < 4u; i += 1u) {
            let part = quincunx_part(q, i);
            if !quincunx_differs(part) {
                sum += quincunx_mean(part, center) / 16.0;
                continue;
            }
            split |= 16u << (4u * subpixel + i);
            for (var j = 0u; j < 4u; j += 1u) {
                sum += quincunx_mean(quincunx_part(part, j), center) / 64.0;
            }
        }
    }
    output(pixel, center + sum);
    inspect_edges(pixel, split);
}

fn quincunx_mean(q: Quad, center: vec3f) -> vec3f {
    return 0.5 * ((quincunx_load(q.inner) - center) + (quincunx_load(q.outer) - center));
}

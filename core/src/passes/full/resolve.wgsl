// Filters the radiances of samples to pixels (Kim 2016, 6.1; lecture, "Supersampling").

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let at = 16u * (group.xy + vec2u(0u, frame.part.first)) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    if pixel.x >= frame.size.x / SAMPLING || pixel.y >= frame.part.end {
        return;
    }
    output(pixel, filter_pixel(pixel));
}

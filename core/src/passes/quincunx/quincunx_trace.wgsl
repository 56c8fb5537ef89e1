// Traces the listed samples, which divide a quarter.

var<storage, read> list: List;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let point = quincunx_point(list.pixels[index]);
    quincunx_store(point, sample_follow(quincunx_ray(point)).color);
    inspect_extra(quincunx_pixel(point));
}

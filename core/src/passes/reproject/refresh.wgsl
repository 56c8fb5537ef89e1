// Reprojection: traces the listed pixels and stores their points for the next frame.

var<storage, read> list: List;

// Farther than any coordinate, yet small enough that products with it do not overflow.
const REFRESH_BEYOND: f32 = 1.0e30;

// The world-space point that a pixel shows. Mirrors and transparent surfaces look different from another
// position, so they have no valid point. The background is a point far away; under an orthographic camera it has
// none, as all rays are parallel.
fn refresh_point(pixel: vec2u, traced: Sample) -> vec3f {
    let hit = traced.attributes.object != 0u;
    if traced.bounced || !(hit || frame.camera.orthographic == 0.0) {
        return vec3f(FAR);
    }
    let ray = frame_ray(pixel);
    return ray.origin + select(REFRESH_BEYOND, traced.attributes.depth, hit) * ray.direction;
}

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let pixel = list_pixel(list.pixels[index]);
    let traced = sample_trace(pixel);
    output(pixel, traced.color);
    history_store(pixel, refresh_point(pixel, traced), traced.color);
    inspect_pixel(pixel, ORIGIN_BASE, traced.attributes);
}

// The light that is filtered. Of few samples, pixels that are much brighter than those around them are taken down: a path
// that meets a small emitter by chance would be spread over all that the filter sees.

// A pixel may be so many times as bright as those around it are in the mean,
const ATROUS_BRIGHTER: f32 = 4.0;
// and from so many samples on as bright as it likes.
const ATROUS_SETTLED: f32 = 16.0;

fn atrous_light(pixel: vec2u, guide: vec4u) -> vec3f {
    return noise_mean(pixel) / filtered_albedo(guide);
}

// The mean luminance of the light around a pixel; negative where nothing like it is there.
fn atrous_around(pixel: vec2u, kind: u32) -> f32 {
    var sum = 0.0;
    var count = 0.0;
    for (var i = 0u; i < 9u; i += 1u) {
        let tap = vec2i(pixel) + vec2i(vec2u(i % 3u, i / 3u)) - 1;
        if i == 4u || !noise_reaches(pixel, tap) {
            continue;
        }
        let guide = guides[guides_place(vec2u(tap))];
        if guides_kind(guide) == kind {
            sum += dot(FILTERED_LUMINANCE, atrous_light(vec2u(tap), guide));
            count += 1.0;
        }
    }
    return select(-1.0, sum / count, count > 0.0);
}

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 16u * order_tile(group, groups, ORDER_RUNS) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    let guide = guides[guides_place(pixel)];
    let kind = guides_kind(guide);
    if kind == GUIDE_NONE {
        return;
    }
    var light = atrous_light(pixel, guide);
    let own = dot(FILTERED_LUMINANCE, light);
    let around = atrous_around(pixel, kind);
    let most = ATROUS_BRIGHTER * around + f32(frame.sample) / ATROUS_SETTLED * own;
    if around >= 0.0 && own > most {
        light *= most / own;
    }
    filtered_store(pixel, light);
}

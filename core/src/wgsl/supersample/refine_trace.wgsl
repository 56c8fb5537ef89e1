// Traces the four samples of a step of a listed pixel, one per thread.

var<workgroup> refine_colors: array<vec3f, TRACE_GROUP>;

struct Refining {
    listed: bool,
    pixel: vec2u,
    step: u32,
    // Which of the step's four samples this thread traces.
    part: u32,
}

fn refine_begin(group: u32, local: u32) -> Refining {
    let index = list.begin + (frame.part.first + group * TRACE_GROUP + local) / REFINE_STEP;
    let listed = index < list.end;
    var entry = 0u;
    if listed {
        entry = list.words[index];
    }
    return Refining(listed, refine_pixel(entry), refine_step(entry), local % REFINE_STEP);
}

// Traces the i-th of the pixel's sixteen samples.
fn refine_trace(pixel: vec2u, i: u32, local: u32) -> vec3f {
    let color = sample_follow(frame_ray_in(4u * pixel + sample_order_stratum(i), 4.0)).color;
    refine_colors[local] = color;
    inspect_extra(pixel);
    return color;
}

// Sum of the four samples of a pixel, from workgroup slot `local` on.
fn refine_sum(local: u32) -> vec3f {
    return refine_colors[local] + refine_colors[local + 1u] + refine_colors[local + 2u] + refine_colors[local + 3u];
}

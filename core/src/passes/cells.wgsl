// Four more samples of each listed pixel, in the cells that the test has chosen.

var<workgroup> cells_colors: array<vec3f, TRACE_GROUP>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + (frame.first + group.x * TRACE_GROUP + local) / REFINE_STEP;
    let listed = index < list.end;
    var entry = 0u;
    if listed {
        entry = list.words[index];
    }
    let pixel = refine_pixel(entry);
    let step = refine_step(entry);
    let part = local % REFINE_STEP;
    var cells = 0u;
    if listed {
        cells = refine_known(pixel) >> REFINE_CELLS_SHIFT;
        let place = order_cell(cells_nth(cells, REFINE_STEP * step + part));
        let traced = sample_follow(frame_ray_in(4u * pixel + place, 4.0));
        cells_colors[local] = traced.color;
        inspect_extra(pixel);
    }
    workgroupBarrier();
    if !listed || part != 0u {
        return;
    }
    var sum = refine_load(pixel, REFINE_SUM);
    sum += cells_colors[local] + cells_colors[local + 1u] + cells_colors[local + 2u] + cells_colors[local + 3u];
    if REFINE_STEP * (step + 1u) < countOneBits(cells) {
        refine_store(pixel, REFINE_SUM, sum);
        refine_append(pixel, step + 1u);
        return;
    }
    output(pixel, sum / f32(REFINE_MOST));
    inspect_refined(pixel, REFINE_FIRST | cells, refine_round(pixel));
}

// The n-th bit that is set, from the lowest on.
fn cells_nth(cells: u32, n: u32) -> u32 {
    var left = cells;
    for (var i = 0u; i < n; i += 1u) {
        left &= left - 1u;
    }
    return countTrailingZeros(left);
}

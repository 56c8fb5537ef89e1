// Traces four samples of each listed pixel, one in each subpixel. Lists a neighbour if these show colours that no
// pixel around it has: lines thinner than a pixel are followed from where a centre hits them (as Kim 2016,
// section 4, spreads from pixel to pixel).

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let its = refine_begin(group.x, local);
    if its.listed {
        refine_store(its.pixel, its.part, refine_trace(its.pixel, its.part, local));
    }
    workgroupBarrier();
    if !its.listed {
        return;
    }
    refine_spread(its.pixel, its.part, local - its.part);
    if its.part == 0u {
        let sum = refine_sum(local);
        refine_store(its.pixel, REFINE_SUM, sum);
        refine_mark(its.pixel, REFINE_TRACED);
        output(its.pixel, (sum + pixel_edges_color(its.pixel)) / 5.0);
        inspect_refined(its.pixel, REFINE_FIRST, refine_round(its.pixel));
    }
}

// Tests a subpixel of a pixel's eight neighbours against its samples, which start at index `local`.
fn refine_spread(pixel: vec2u, part: u32, local: u32) {
    var shown: array<vec3f, 4>;
    for (var i = 0u; i < REFINE_STEP; i += 1u) {
        shown[i] = contrast_shown(refine_colors[local + i]);
    }
    for (var i = 2u * part; i < 2u * part + 2u; i += 1u) {
        // Skips index 4, the pixel itself.
        let index = select(i, i + 1u, i >= 4u);
        let beside = vec2i(pixel) + vec2i(i32(index % 3u), i32(index / 3u)) - 1;
        let inside = beside.x >= 0 && beside.y >= i32(frame.part.row) && beside.x < i32(frame.size.x) && beside.y < i32(frame.part.end);
        if !inside || refine_state(vec2u(beside)) != 0u || !refine_shows_new(vec2u(beside), shown) {
            continue;
        }
        if refine_claim(vec2u(beside), refine_round(pixel) + 1u) {
            refine_append(vec2u(beside), 0u);
        }
    }
}

// Whether samples near a neighbour lie outside the range of colours in the pixels around it.
fn refine_shows_new(neighbour: vec2u, shown: array<vec3f, 4>) -> bool {
    let range = contrast_range(neighbour);
    for (var i = 0u; i < REFINE_STEP; i += 1u) {
        let nearest = clamp(shown[i], range.low, range.high);
        if contrast_exceeds(min(shown[i], nearest), max(shown[i], nearest), frame.tolerances.tau_least) {
            return true;
        }
    }
    return false;
}

// Four more samples of each listed pixel, which is listed again where they differ. Where the first four show what no pixel around
// a neighbour does, the neighbour is listed too: a line thinner than a pixel is followed from where a centre hits it (as Kim 2016,
// section 4, spreads from pixel to pixel).

var<workgroup> refine_colors: array<vec3f, TRACE_GROUP>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + (frame.first + group.x * TRACE_GROUP + local) / REFINE_STEP;
    let listed = index < list.end;
    var entry = 0u;
    if listed {
        entry = list.words[index];
    }
    let pixel = refine_pixel(entry);
    let taken = refine_taken(entry);
    let part = local % REFINE_STEP;
    if listed {
        let traced = sample_follow(frame_ray_in(4u * pixel + order_cell(taken + part), 4.0));
        refine_colors[local] = traced.color;
        inspect_extra(pixel);
    }
    workgroupBarrier();
    if listed && taken == 0u {
        refine_spread(pixel, part, local - part);
    }
    if listed && part == 0u {
        refine_add(pixel, taken, local);
    }
}

// The samples of a pixel whose first four, or next four, are from that place on.
fn refine_add(pixel: vec2u, before: u32, local: u32) {
    let center = edges_color(pixel);
    var known = refine_begin(center);
    if before > 0u {
        known = refine_load(pixel);
    }
    known.sum += refine_colors[local] + refine_colors[local + 1u] + refine_colors[local + 2u] + refine_colors[local + 3u];
    for (var i = 0u; i < REFINE_STEP; i += 1u) {
        let shown = contrast_shown(refine_colors[local + i]);
        known.low = min(known.low, shown);
        known.high = max(known.high, shown);
    }
    let taken = before + REFINE_STEP;
    output(pixel, refine_mean(known, center, taken));
    inspect_refined(pixel, taken, refine_round(pixel));
    if refine_goes_on(known, taken) {
        refine_store(pixel, known);
        refine_append(pixel, taken);
    }
}

// A quarter of the neighbours of a pixel, by its samples from that place on.
fn refine_spread(pixel: vec2u, part: u32, local: u32) {
    var shown: array<vec3f, 4>;
    for (var i = 0u; i < REFINE_STEP; i += 1u) {
        shown[i] = contrast_shown(refine_colors[local + i]);
    }
    for (var i = 2u * part; i < 2u * part + 2u; i += 1u) {
        // The fifth is the pixel itself.
        let index = select(i, i + 1u, i >= 4u);
        let beside = vec2i(pixel) + vec2i(i32(index % 3u), i32(index / 3u)) - 1;
        let inside = beside.x >= 0 && beside.y >= i32(frame.row) && beside.x < i32(frame.size.x) && beside.y < i32(frame.end);
        if !inside || refine_claimed(vec2u(beside)) || !refine_surprises(vec2u(beside), shown) {
            continue;
        }
        if refine_claim(vec2u(beside), refine_round(pixel) + 1u) {
            refine_append(vec2u(beside), 0u);
        }
    }
}

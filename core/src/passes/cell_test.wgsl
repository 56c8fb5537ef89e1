// Which of the other twelve cells of a refined pixel get a sample: Jin's test (2009, 4.2.2) once more, with quarters in place of
// pixels. Quarters of refined pixels are as their sample is, the others as their pixel.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let pixel = refine_pixel(list.words[index]);
    if (refine_known(pixel) & REFINE_TRACED) == 0u {
        return;
    }
    let differing = cell_differing(pixel);
    if differing == 0u {
        return;
    }
    let cells = cell_filled(differing);
    var sum = refine_load(pixel, REFINE_SUM);
    for (var i = REFINE_STEP; i < REFINE_MOST; i += 1u) {
        // A stratum without a sample takes the colour of its subpixel's sample.
        if (cells & (1u << i)) == 0u {
            sum += refine_load(pixel, refine_in_quarter(cell_quarter(order_cell(i))));
        }
    }
    refine_store(pixel, REFINE_SUM, sum);
    refine_tell(pixel, cells << REFINE_CELLS_SHIFT);
    refine_append(pixel, 0u);
}

fn cell_quarter(cell: vec2u) -> u32 {
    return cell.x / 2u + 2u * (cell.y / 2u);
}

// Bit i: the cell of sample i lies where quarters differ.
fn cell_differing(pixel: vec2u) -> u32 {
    // Those of the pixel and those around them.
    var shown: array<vec3f, 16>;
    for (var i = 0u; i < 16u; i += 1u) {
        shown[i] = cell_shown(pixel, i);
    }
    var differing = 0u;
    for (var i = REFINE_STEP; i < REFINE_MOST; i += 1u) {
        let cell = order_cell(i);
        let own = cell / 2u + 1u;
        let beside = own + 2u * (cell % 2u) - 1u;
        let a = shown[own.x + 4u * own.y];
        let b = shown[beside.x + 4u * own.y];
        let c = shown[own.x + 4u * beside.y];
        let d = shown[beside.x + 4u * beside.y];
        let low = min(min(a, b), min(c, d));
        let high = max(max(a, b), max(c, d));
        differing |= select(0u, 1u << i, contrast_exceeds(low, high, CELL_CONTRAST * frame.tolerances.tau_least));
    }
    return differing;
}

// The i-th of the 4x4 quarters in and around a pixel, row by row from the upper left; beyond the frame, the nearest inside.
fn cell_shown(pixel: vec2u, i: u32) -> vec3f {
    let at = clamp(2 * vec2i(pixel) + vec2i(i32(i % 4u), i32(i / 4u)) - 1, vec2i(0), 2 * vec2i(frame.size) - 1);
    let owner = vec2u(at) / 2u;
    let stored = owner.y >= frame.part.row && owner.y < frame.part.end;
    if !stored || (refine_known(owner) & REFINE_TRACED) == 0u {
        return contrast_shown(edges_color(edges_inside(vec2i(owner))));
    }
    let quarter = (u32(at.x) & 1u) + 2u * (u32(at.y) & 1u);
    return contrast_shown(refine_load(owner, refine_in_quarter(quarter)));
}

// As many more in their order as make whole steps.
fn cell_filled(differing: u32) -> u32 {
    var cells = differing;
    for (var i = REFINE_STEP; countOneBits(cells) % REFINE_STEP != 0u; i += 1u) {
        cells |= 1u << i;
    }
    return cells;
}

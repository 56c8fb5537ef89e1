// Selects which of the other twelve strata of a refined pixel get a sample: Jin's test (2009, 4.2.2) with subpixels
// in place of pixels. A subpixel of a refined pixel has the colour of its sample, one of another pixel that of the
// pixel.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = list.begin + frame.part.first + group.x * TRACE_GROUP + local;
    if index >= list.end {
        return;
    }
    let pixel = refine_pixel(list.words[index]);
    if (refine_state(pixel) & REFINE_TRACED) == 0u {
        return;
    }
    let differing = strata_differing(pixel);
    if differing == 0u {
        return;
    }
    let strata = strata_padded(differing);
    var sum = refine_load(pixel, REFINE_SUM);
    for (var i = REFINE_STEP; i < REFINE_MOST; i += 1u) {
        // A stratum without a sample takes the colour of its subpixel's sample.
        if (strata & (1u << i)) == 0u {
            sum += refine_load(pixel, refine_in_subpixel(stratum_subpixel(sample_order_stratum(i))));
        }
    }
    refine_store(pixel, REFINE_SUM, sum);
    refine_mark(pixel, strata << REFINE_STRATA_SHIFT);
    refine_append(pixel, 0u);
}

fn stratum_subpixel(stratum: vec2u) -> u32 {
    return stratum.x / 2u + 2u * (stratum.y / 2u);
}

// Mask of the strata that lie between differing subpixels; bit i is the stratum of sample i.
fn strata_differing(pixel: vec2u) -> u32 {
    // The subpixels of the pixel and those around it.
    var shown: array<vec3f, 16>;
    for (var i = 0u; i < 16u; i += 1u) {
        shown[i] = stratum_neighbour(pixel, i);
    }
    var differing = 0u;
    for (var i = REFINE_STEP; i < REFINE_MOST; i += 1u) {
        let stratum = sample_order_stratum(i);
        let own = stratum / 2u + 1u;
        let beside = own + 2u * (stratum % 2u) - 1u;
        let a = shown[own.x + 4u * own.y];
        let b = shown[beside.x + 4u * own.y];
        let c = shown[own.x + 4u * beside.y];
        let d = shown[beside.x + 4u * beside.y];
        let low = min(min(a, b), min(c, d));
        let high = max(max(a, b), max(c, d));
        differing |= select(0u, 1u << i, contrast_exceeds(low, high, STRATUM_CONTRAST * frame.tolerances.tau_least));
    }
    return differing;
}

// Colour of the i-th of the 4x4 subpixels in and around a pixel, row by row from the upper left; beyond the frame,
// of the nearest one inside.
fn stratum_neighbour(pixel: vec2u, i: u32) -> vec3f {
    let at = clamp(2 * vec2i(pixel) + vec2i(i32(i % 4u), i32(i / 4u)) - 1, vec2i(0), 2 * vec2i(frame.size) - 1);
    let owner = vec2u(at) / 2u;
    let stored = owner.y >= frame.part.row && owner.y < frame.part.end;
    if !stored || (refine_state(owner) & REFINE_TRACED) == 0u {
        return contrast_shown(pixel_edges_color(pixel_edges_inside(vec2i(owner))));
    }
    let subpixel = (u32(at.x) & 1u) + 2u * (u32(at.y) & 1u);
    return contrast_shown(refine_load(owner, refine_in_subpixel(subpixel)));
}

// Adds the next strata in sampling order until their number fills whole steps.
fn strata_padded(differing: u32) -> u32 {
    var strata = differing;
    for (var i = REFINE_STEP; countOneBits(strata) % REFINE_STEP != 0u; i += 1u) {
        strata |= 1u << i;
    }
    return strata;
}

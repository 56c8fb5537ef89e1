// Traces four more samples of each listed pixel, in the strata that the test has selected.

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let its = refine_begin(group.x, local);
    var strata = 0u;
    if its.listed {
        strata = refine_state(its.pixel) >> REFINE_STRATA_SHIFT;
        refine_trace(its.pixel, strata_nth(strata, REFINE_STEP * its.step + its.part), local);
    }
    workgroupBarrier();
    if !its.listed || its.part != 0u {
        return;
    }
    let sum = refine_load(its.pixel, REFINE_SUM) + refine_sum(local);
    if REFINE_STEP * (its.step + 1u) < countOneBits(strata) {
        refine_store(its.pixel, REFINE_SUM, sum);
        refine_append(its.pixel, its.step + 1u);
        return;
    }
    output(its.pixel, sum / f32(REFINE_MOST));
    inspect_refined(its.pixel, REFINE_FIRST | strata, refine_round(its.pixel));
}

// Index of the n-th set bit, counted from 0 at the lowest.
fn strata_nth(strata: u32, n: u32) -> u32 {
    var left = strata;
    for (var i = 0u; i < n; i += 1u) {
        left &= left - 1u;
    }
    return countTrailingZeros(left);
}

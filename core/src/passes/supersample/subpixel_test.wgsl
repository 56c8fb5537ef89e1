// ActSubPixDetector (Jin 2009, 4.1.3, 4.2.2, 4.3.2): lists the subpixels that get extra samples, in the
// order of a curve through the tile. Deviations: a thread tests all four subpixels, so that neighbours are read
// once; and a tile reserves exactly the list entries that it needs.

var<workgroup> test_masks: array<u32, 64>;
var<workgroup> test_lengths: array<u32, ACTIVE_RUN>;
var<workgroup> test_places: array<u32, 64>;

@compute @workgroup_size(64)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let at = 8u * tile_order(group, groups, TILE_ORDER_RUN) + frame_tile(local);
    let pixel = at + vec2u(0u, frame.part.row);
    var mask = 0u;
    if pixel.x < frame.size.x && pixel.y < frame.part.end {
        let test = subpixels_test(pixel);
        mask = test.subpixels;
        unsampled_output(pixel, mask);
        inspect_edges(pixel, test.subpixels | (test.differing << 4u));
    }
    test_masks[local] = mask;
    workgroupBarrier();
    if local < ACTIVE_RUN {
        var place = local;
        for (var i = 0u; i < 64u; i += 1u) {
            let count = countOneBits(test_masks[i]);
            place = test_fitting(place, count) + count;
        }
        test_lengths[local] = place - local;
    }
    workgroupBarrier();
    if local == 0u {
        var place = test_reserve();
        for (var i = 0u; i < 64u; i += 1u) {
            let count = countOneBits(test_masks[i]);
            let fitting = test_fitting(place, count);
            for (; place < fitting; place += 1u) {
                list.pixels[place] = ACTIVE_NONE;
            }
            test_places[i] = place;
            place += count;
        }
    }
    workgroupBarrier();
    var place = test_places[local];
    for (var left = mask; left != 0u; left &= left - 1u) {
        list.pixels[place] = active_entry(pixel, countTrailingZeros(left), left == mask);
        place += 1u;
    }
}

// The first index from `place` on where `count` entries fit into one run.
fn test_fitting(place: u32, count: u32) -> u32 {
    let over = place % ACTIVE_RUN + count > ACTIVE_RUN;
    return select(place, (place / ACTIVE_RUN + 1u) * ACTIVE_RUN, over);
}

// Reserves list entries for the tile and returns the first. The number depends on where they begin.
fn test_reserve() -> u32 {
    var place = atomicLoad(&list.count);
    loop {
        let length = test_lengths[place % ACTIVE_RUN];
        if length == 0u {
            break;
        }
        let result = atomicCompareExchangeWeak(&list.count, place, place + length);
        if result.exchanged {
            break;
        }
        place = result.old_value;
    }
    return place;
}

// Replaces pixels whose last path was stopped on diffuse surfaces by the median of their 3x3 pixels, channel by
// channel (Kim & Sung 2021, Algorithm 5, lines 10 to 14). Taps outside the image count as the pixel itself.

struct Sorted {
    low: vec3f,
    middle: vec3f,
    high: vec3f,
}

fn median_sorted(a: vec3f, b: vec3f, c: vec3f) -> Sorted {
    let low = min(a, b);
    let high = max(a, b);
    return Sorted(min(low, c), max(low, min(high, c)), max(high, c));
}

fn median_tap(pixel: vec2u, x: i32, y: i32) -> vec3f {
    let tap = vec2i(pixel) + vec2i(x, y);
    return samples_mean(select(pixel, vec2u(tap), denoise_tap_is_inside(pixel, tap)));
}

fn median_column(pixel: vec2u, x: i32) -> Sorted {
    return median_sorted(median_tap(pixel, x, -1), median_tap(pixel, x, 0), median_tap(pixel, x, 1));
}

@compute @workgroup_size(256)
fn main(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) local: u32,
) {
    let pixel = 16u * tile_order(group, groups, TILE_ORDER_RUN) + frame_tile(local);
    if any(pixel >= frame.size) {
        return;
    }
    if gbuffer[gbuffer_place(pixel)].w == 0u {
        output(pixel, samples_mean(pixel));
        return;
    }
    // The median of nine is the median of three values: the largest of the columns' minima, the median of their
    // medians and the smallest of their maxima (Smith 1996).
    let a = median_column(pixel, -1);
    let b = median_column(pixel, 0);
    let c = median_column(pixel, 1);
    let low = median_sorted(a.low, b.low, c.low).high;
    let middle = median_sorted(a.middle, b.middle, c.middle).middle;
    let high = median_sorted(a.high, b.high, c.high).low;
    output(pixel, median_sorted(low, middle, high).middle);
}

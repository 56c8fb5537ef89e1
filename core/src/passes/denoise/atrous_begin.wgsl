// Prepares the light for the a-trous filter. While there are few samples, pixels much brighter than their
// neighbours are clamped: a path that meets a small emitter by chance would spread over the whole footprint of
// the filter.

// Limit of a pixel's brightness after one sample, as a multiple of the mean of its four neighbours.
const ATROUS_BRIGHTER: f32 = 4.0;
// Number of samples from which brightness is no longer clamped.
const ATROUS_SETTLED: f32 = 256.0;

// Brightness of a pixel's light divided by that of its albedo.
fn atrous_brightness(pixel: vec2u, gbuffer_pixel: vec4u) -> f32 {
    return atrous_buffer_sum(samples_mean(pixel)) / atrous_buffer_sum(atrous_buffer_albedo(gbuffer_pixel));
}

// Brightness of a pixel after clamping.
fn atrous_kept(pixel: vec2u, kind: u32, own: f32) -> f32 {
    var sum = 0.0;
    var count = 0.0;
    for (var side = 0; side < 4; side += 1) {
        let at = vec2i(pixel) + select(vec2i(2 * side - 5, 0), vec2i(0, 2 * side - 1), side < 2);
        let reached = denoise_tap_is_inside(pixel, at);
        let tap = select(pixel, vec2u(at), reached);
        let gbuffer_pixel = gbuffer[gbuffer_place(tap)];
        let counts = reached && gbuffer_kind(gbuffer_pixel) == kind;
        sum += select(0.0, atrous_brightness(tap, gbuffer_pixel), counts);
        count += f32(counts);
    }
    let most = ATROUS_BRIGHTER * sum / max(count, 1.0);
    let settled = min(f32(frame.paths.sample + frame.paths.merged) / ATROUS_SETTLED, 1.0);
    return select(own, mix(most, own, settled * settled), count > 0.0 && own > most);
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
    let gbuffer_pixel = gbuffer[gbuffer_place(pixel)];
    let kind = gbuffer_kind(gbuffer_pixel);
    if kind == GBUFFER_NONE {
        atrous_buffer[gbuffer_place(pixel)] = vec4u(0u);
        return;
    }
    let own = atrous_brightness(pixel, gbuffer_pixel);
    let kept = atrous_kept(pixel, kind, own) / max(own, ATROUS_BUFFER_BLACK);
    let light = kept * samples_mean(pixel) / atrous_buffer_albedo(gbuffer_pixel);
    atrous_buffer[gbuffer_place(pixel)] = vec4u(atrous_buffer_guide(gbuffer_pixel), atrous_buffer_light(light));
}

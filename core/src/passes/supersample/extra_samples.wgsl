// ExtraSampler (Jin 2009, 4.1.4, 4.3.3): traces four rays for each active subpixel; a pixel's master thread sums
// them.

var<storage, read> list: List;

var<workgroup> extra_colors: array<vec3f, TRACE_GROUP>;

@compute @workgroup_size(TRACE_GROUP)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) local: u32) {
    let index = (frame.part.first + group.x * TRACE_GROUP + local) / ACTIVE_SAMPLES;
    var entry = ACTIVE_NONE;
    if index < list.end {
        entry = list.pixels[index];
    }
    let pixel = active_pixel(entry);
    if entry != ACTIVE_NONE {
        let subpixel = active_subpixel(entry);
        let place = 2u * vec2u(subpixel & 1u, subpixel >> 1u) + vec2u(local & 1u, (local >> 1u) & 1u);
        let traced = sample_follow(frame_ray_in(4u * pixel + place, 4.0));
        extra_colors[local] = traced.color;
        inspect_extra(pixel);
    }
    workgroupBarrier();
    let first_of_pixel = entry != ACTIVE_NONE && (entry & ACTIVE_MASTER) != 0u && local % ACTIVE_SAMPLES == 0u;
    if first_of_pixel {
        output(pixel, extra_pixel(entry, index, local));
    }
}

// Radiance of the pixel whose first active subpixel is at `index` in the list; its samples start at `local` in
// the workgroup.
fn extra_pixel(master: u32, index: u32, local: u32) -> vec3f {
    let pixel = active_pixel(master);
    let center = pixel_edges_color(pixel);
    var mask = 0u;
    // Sums differences from the centre: equal samples then have exactly that mean.
    var difference = vec3f(0.0);
    for (var i = 0u; i < 4u; i += 1u) {
        if index + i >= list.end || local / ACTIVE_SAMPLES + i >= ACTIVE_RUN {
            break;
        }
        let entry = list.pixels[index + i];
        if !active_same(entry, master) {
            break;
        }
        mask |= 1u << active_subpixel(entry);
        let at = local + ACTIVE_SAMPLES * i;
        let a = extra_colors[at];
        let b = extra_colors[at + 1u];
        let c = extra_colors[at + 2u];
        let d = extra_colors[at + 3u];
        difference += (a - center) + (b - center) + (c - center) + (d - center);
    }
    if mask == 15u {
        return extra_sum(local) / 16.0;
    }
    return center + difference / 16.0 + unsampled_correction(pixel, mask);
}

// Sum of all sixteen samples of a pixel, in sampling order.
fn extra_sum(local: u32) -> vec3f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < 16u; i += 4u) {
        let a = extra_colors[local + extra_place(i)];
        let b = extra_colors[local + extra_place(i + 1u)];
        let c = extra_colors[local + extra_place(i + 2u)];
        let d = extra_colors[local + extra_place(i + 3u)];
        sum += a + b + c + d;
    }
    return sum;
}

// Index in the workgroup of the i-th of sixteen samples; they are stored subpixel by subpixel.
fn extra_place(i: u32) -> u32 {
    let stratum = sample_order_stratum(i);
    return 4u * (stratum.x / 2u + 2u * (stratum.y / 2u)) + stratum.x % 2u + 2u * (stratum.y % 2u);
}

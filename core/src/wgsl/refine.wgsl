// What is known of a pixel from its samples so far, and what follows from it.

struct Refined {
    // Without the centre.
    sum: vec3f,
    // The darkest and the brightest with the centre, as shown.
    low: vec3f,
    high: vec3f,
}

fn refine_begin(center: vec3f) -> Refined {
    let shown = contrast_shown(center);
    return Refined(vec3f(0.0), shown, shown);
}

fn refine_place(pixel: vec2u) -> u32 {
    let entries = arrayLength(&list.words) / (REFINE_MOST / REFINE_STEP + REFINE_WORDS) * (REFINE_MOST / REFINE_STEP);
    return entries + REFINE_WORDS * (frame_folded(pixel.y) * frame.size.x + pixel.x);
}

fn refine_load_at(place: u32) -> vec3f {
    return bitcast<vec3f>(vec3u(list.words[place], list.words[place + 1u], list.words[place + 2u]));
}

fn refine_load(pixel: vec2u) -> Refined {
    let place = refine_place(pixel);
    return Refined(refine_load_at(place), refine_load_at(place + 3u), refine_load_at(place + 6u));
}

fn refine_store_at(place: u32, value: vec3f) {
    let words = bitcast<vec3u>(value);
    list.words[place] = words.x;
    list.words[place + 1u] = words.y;
    list.words[place + 2u] = words.z;
}

fn refine_store(pixel: vec2u, known: Refined) {
    let place = refine_place(pixel);
    refine_store_at(place, known.sum);
    refine_store_at(place + 3u, known.low);
    refine_store_at(place + 6u, known.high);
}

// Sixteen samples are averaged as a grid of them is, fewer together with the centre.
fn refine_mean(known: Refined, center: vec3f, taken: u32) -> vec3f {
    if taken == REFINE_MOST {
        return known.sum / f32(REFINE_MOST);
    }
    return (known.sum + center) / f32(taken + 1u);
}

// Four that differ become eight; eight that differ four times as much become sixteen.
fn refine_goes_on(known: Refined, taken: u32) -> bool {
    let factor = select(1.0, 4.0, taken == 8u);
    return taken < REFINE_MOST && (taken == 12u || contrast_exceeds(known.low, known.high, factor * frame.tau_least));
}

// Do samples around a neighbour show what no pixel around it does?
fn refine_surprises(neighbour: vec2u, shown: array<vec3f, 4>) -> bool {
    var low = vec3f(1.0);
    var high = vec3f(0.0);
    for (var i = 0u; i < 9u; i += 1u) {
        let around = contrast_shown(edges_color(edges_neighbour(neighbour, i)));
        low = min(low, around);
        high = max(high, around);
    }
    for (var i = 0u; i < REFINE_STEP; i += 1u) {
        let nearest = clamp(shown[i], low, high);
        if contrast_exceeds(min(shown[i], nearest), max(shown[i], nearest), frame.tau_least) {
            return true;
        }
    }
    return false;
}

fn refine_round(pixel: vec2u) -> u32 {
    return attributes_read(edges_place(pixel, EDGE_ROUND)) - 1u;
}

fn refine_claimed(pixel: vec2u) -> bool {
    return attributes_read(edges_place(pixel, EDGE_ROUND)) != 0u;
}

// Is the pixel this thread's to list, for that round?
fn refine_claim(pixel: vec2u, round: u32) -> bool {
    return atomicMax(&attributes[edges_place(pixel, EDGE_ROUND)], round + 1u) == 0u;
}

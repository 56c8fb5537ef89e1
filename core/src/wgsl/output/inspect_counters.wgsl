// Counts rays, samples and traversal work, and keeps a record of every pixel unless pixels have several samples.

struct PixelRecord {
    origin: u32,
    failed: u32,
    cost: atomic<u32>,
    object: u32,
    depth: f32,
    normal: u32,
    // Active subpixels in bits 0 to 3, then the differing attributes (`subpixels.wgsl`); from bit 20 on, 1 + the
    // round of a refined pixel.
    edges: u32,
    // Mask of a refined pixel's samples, in sampling order.
    strata: u32,
}

struct Inspection {
    // A low and a high word for each counter.
    counters: array<atomic<u32>, COUNTER_WORDS>,
    pixels: array<PixelRecord>,
}

var<storage, read_write> inspection: Inspection;

var<private> inspect_rays: array<u32, RAY_COUNT>;
var<private> inspect_costs: array<u32, COST_COUNT>;

fn inspect_step(kind: u32) {
    inspect_costs[kind] += 1u;
}

fn inspect_ray(kind: u32) {
    inspect_rays[kind] += 1u;
}

fn inspect_count(counter: u32, amount: u32) {
    if amount == 0u {
        return;
    }
    let before = atomicAdd(&inspection.counters[2u * counter], amount);
    if before + amount < before {
        atomicAdd(&inspection.counters[2u * counter + 1u], 1u);
    }
}

// Records the checks that a listed pixel fails; tracing the pixel fills in the rest of its record.
fn inspect_failed(pixel: vec2u, failed: u32) {
    for (var check = 0u; check < CHECK_COUNT; check += 1u) {
        inspect_count(COUNTER_FAILED + check, (failed >> check) & 1u);
    }
    if HAS_RECORDS {
        inspection.pixels[pixel.y * frame.size.x + pixel.x].failed = failed;
    }
}

// Counts a pixel that postcorrection has claimed.
fn inspect_claimed() {
    inspect_count(COUNTER_POSTCORRECTION + POSTCORRECTION_CLAIMED, 1u);
}

// Counts a sample of `origin` with the work since the last call; returns its traversal cost.
fn inspect_work(origin: u32) -> u32 {
    inspect_count(COUNTER_ORIGINS + origin, 1u);
    return inspect_cost();
}

fn inspect_cost() -> u32 {
    for (var kind = 0u; kind < RAY_COUNT; kind += 1u) {
        inspect_count(COUNTER_RAYS + kind, inspect_rays[kind]);
        inspect_rays[kind] = 0u;
    }
    let cost = inspect_costs[COST_NODE_VISITS] + inspect_costs[COST_PRIMITIVE_TESTS];
    for (var kind = 0u; kind < COST_COUNT; kind += 1u) {
        inspect_count(COUNTER_COST + kind, inspect_costs[kind]);
        inspect_costs[kind] = 0u;
    }
    return cost;
}

fn inspect_pixel(pixel: vec2u, origin: u32, attributes: Attributes) {
    let cost = inspect_work(origin);
    if HAS_RECORDS {
        let index = pixel.y * frame.size.x + pixel.x;
        inspection.pixels[index].origin = origin;
        atomicStore(&inspection.pixels[index].cost, cost);
        inspection.pixels[index].object = attributes.object;
        inspection.pixels[index].depth = attributes.depth;
        inspection.pixels[index].normal = octahedral_encode(attributes.normal);
    }
}

// Counts a sample in addition to the one that the record describes.
fn inspect_extra(pixel: vec2u) {
    inspect_count(COUNTER_ORIGINS + ORIGIN_EXTRA, 1u);
    inspect_more(pixel);
}

// Counts more work for the sample that the record describes.
fn inspect_more(pixel: vec2u) {
    let cost = inspect_cost();
    if HAS_RECORDS {
        atomicAdd(&inspection.pixels[pixel.y * frame.size.x + pixel.x].cost, cost);
    }
}

// Records the result of the subpixel test.
fn inspect_edges(pixel: vec2u, edges: u32) {
    if HAS_RECORDS {
        inspection.pixels[pixel.y * frame.size.x + pixel.x].edges = edges;
    }
}

// Records the samples of a refined pixel and its round.
fn inspect_refined(pixel: vec2u, strata: u32, round: u32) {
    if HAS_RECORDS {
        let index = pixel.y * frame.size.x + pixel.x;
        let steps = countOneBits(strata) / REFINE_STEP;
        inspection.pixels[index].edges |= ((1u << steps) - 1u) | ((round + 1u) << 20u);
        inspection.pixels[index].strata = strata;
    }
}

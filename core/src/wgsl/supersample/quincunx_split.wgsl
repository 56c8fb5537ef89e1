// Divides a quad: lists the samples that the division needs, each once even if several quads share it.

// A claim bit for each of a pixel's sixteen lattice samples.
var<storage, read_write> attributes: array<atomic<u32>>;

fn quincunx_split(q: Quad) {
    let middle = quincunx_middle(q);
    if (middle.x & 1u) != 0u {
        quincunx_append(middle);
    } else {
        quincunx_claim(middle);
    }
    let beside = quincunx_beside(q);
    quincunx_claim(beside[0]);
    quincunx_claim(beside[1]);
}

fn quincunx_claim(point: vec2u) {
    let pixel = point / 8u;
    let inside = point % 8u / QUINCUNX_STEP;
    let bit = 1u << (4u * inside.y + inside.x);
    let before = atomicOr(&attributes[pixel.y * (frame.size.x + 1u) + pixel.x], bit);
    if (before & bit) == 0u {
        quincunx_append(point);
    }
}

fn quincunx_append(point: vec2u) {
    list.pixels[atomicAdd(&list.count, 1u)] = quincunx_entry(point);
}

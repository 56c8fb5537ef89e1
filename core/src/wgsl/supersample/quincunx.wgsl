// Samples of the recursive quincunx (lecture, "Adaptive supersampling"): centre and corners of a pixel, then two
// levels of those of quads whose diagonal samples differ. Points are in eighths of a pixel, with rows counted
// from the band's first. Every sample has its own storage: those on the lattice of quarter pixels, which quads
// share, and the centres of the smallest quads, which they do not.

var<storage, read_write> samples: array<f32>;

// Distance of neighbouring lattice samples, in eighths of a pixel.
const QUINCUNX_STEP: u32 = 2u;

fn quincunx_place(point: vec2u) -> u32 {
    let across = 4u * frame.size.x;
    if (point.x & 1u) == 0u {
        return 3u * (point.y / QUINCUNX_STEP * (across + 1u) + point.x / QUINCUNX_STEP);
    }
    let lattice = (4u * (frame.part.end - frame.part.row) + 1u) * (across + 1u);
    return 3u * (lattice + point.y / QUINCUNX_STEP * across + point.x / QUINCUNX_STEP);
}

fn quincunx_load(point: vec2u) -> vec3f {
    let place = quincunx_place(point);
    return vec3f(samples[place], samples[place + 1u], samples[place + 2u]);
}

fn quincunx_store(point: vec2u, color: vec3f) {
    let place = quincunx_place(point);
    samples[place] = color.x;
    samples[place + 1u] = color.y;
    samples[place + 2u] = color.z;
}

// A square, given by the samples at opposite corners: the inner one, at the centre of the parent quad, and the
// outer one.
struct Quad {
    inner: vec2u,
    outer: vec2u,
}

// A quarter of a pixel, from the centre to a corner.
fn quincunx_quad(pixel: vec2u, subpixel: u32) -> Quad {
    let corner = vec2u(subpixel & 1u, subpixel >> 1u);
    return Quad(8u * pixel + 4u, 8u * (pixel + corner));
}

// The samples at the other two corners of a quad.
fn quincunx_beside(q: Quad) -> array<vec2u, 2> {
    return array<vec2u, 2>(vec2u(q.inner.x, q.outer.y), vec2u(q.outer.x, q.inner.y));
}

fn quincunx_middle(q: Quad) -> vec2u {
    return (q.inner + q.outer) / 2u;
}

// A quarter of a quad, from its centre to one of its corners, in the order inner, beside, beside, outer.
fn quincunx_part(q: Quad, part: u32) -> Quad {
    let x = select(q.inner.x, q.outer.x, (part & 1u) != 0u);
    let y = select(q.inner.y, q.outer.y, (part & 2u) != 0u);
    return Quad(quincunx_middle(q), vec2u(x, y));
}

fn quincunx_differs(q: Quad) -> bool {
    let a = contrast_shown(quincunx_load(q.inner));
    let b = contrast_shown(quincunx_load(q.outer));
    return contrast_exceeds(min(a, b), max(a, b), frame.tolerances.quincunx_threshold);
}

// The pixel that counts a sample shared by several pixels.
fn quincunx_pixel(point: vec2u) -> vec2u {
    return min(point / 8u + vec2u(0u, frame.part.row), frame.size - 1u);
}

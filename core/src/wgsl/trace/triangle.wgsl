// Ray-triangle test in ray space (Woop, Benthin & Wald 2013): the corners, relative to the ray's origin, are
// sheared along the ray, so that the ray hits a triangle whose edge functions have the same sign. Two-sided.
// `triangle_edge_exact.wgsl` decides the signs so that a closed mesh is crossed the right number of times.

struct TriangleHit {
    t: f32,
    // Barycentric weights of the second and third corner.
    u: f32,
    v: f32,
    hit: bool,
}

// Per-ray terms: the axis of the largest component becomes z, and the others are sheared to zero.
struct Shear {
    origin: vec3f,
    axis: u32,
    shear: vec3f,
}

fn triangle_permute(v: vec3f, axis: u32) -> vec3f {
    return select(select(v, v.zxy, axis == 1u), v.yzx, axis == 0u);
}

fn triangle_shear(ray: Ray) -> Shear {
    let size = abs(ray.direction);
    let axis = select(select(2u, 1u, size.y >= size.z), 0u, size.x >= max(size.y, size.z));
    let d = triangle_permute(ray.direction, axis);
    return Shear(ray.origin, axis, vec3f(d.x / d.z, d.y / d.z, 1.0 / d.z));
}

// Transforms a corner; bitwise the same whatever triangle it belongs to and whichever corner it is.
fn triangle_flatten(shear: Shear, corner: vec3f) -> vec2f {
    return corner.xy - triangle_edge_rounded(shear.shear.xy * corner.z);
}

fn triangle_hit(shear: Shear, corners: array<vec3f, 3>, t_max: f32) -> TriangleHit {
    let a = triangle_permute(corners[0] - shear.origin, shear.axis);
    let b = triangle_permute(corners[1] - shear.origin, shear.axis);
    let c = triangle_permute(corners[2] - shear.origin, shear.axis);
    let a2 = triangle_flatten(shear, a);
    let b2 = triangle_flatten(shear, b);
    let c2 = triangle_flatten(shear, c);
    var found: TriangleHit;
    var edges = triangle_edge_functions(a2, b2, c2);
    if triangle_edge_inside(edges, a2, b2, c2) {
        var determinant = edges.x + edges.y + edges.z;
        if abs(determinant) < TRIANGLE_SMALL || abs(determinant) > TRIANGLE_LARGE {
            edges = triangle_scaled_edges(a2, b2, c2);
            determinant = edges.x + edges.y + edges.z;
        }
        // The weights have one sign or are zero, so that their sum does not cancel.
        let weights = edges * (1.0 / determinant);
        let t = shear.shear.z * (weights.x * a.z + weights.y * b.z + weights.z * c.z);
        found = TriangleHit(t, weights.y, weights.z, t > 0.0 && t < t_max);
    }
    return found;
}

// Limits beyond which a product of weight and coordinate, or the reciprocal, may leave the range of f32.
const TRIANGLE_SMALL: f32 = 1.0e-30;
const TRIANGLE_LARGE: f32 = 1.0e37;

// Edge functions scaled by a power of two; those of the first corner if all are zero.
fn triangle_scaled_edges(a: vec2f, b: vec2f, c: vec2f) -> vec3f {
    let sizes = max(max(abs(a), abs(b)), abs(c));
    let exponent = clamp(bitcast<u32>(max(sizes.x, sizes.y)) >> 23u, 1u, 253u);
    let unit = bitcast<f32>((254u - exponent) << 23u);
    let edges = triangle_edge_functions(a * unit, b * unit, c * unit);
    let lost = abs(edges.x + edges.y + edges.z) < TRIANGLE_SMALL;
    return select(edges, vec3f(1.0, 0.0, 0.0), lost);
}

// Edge functions p x q of a triangle's corners around the ray, with signs that are exact for the sheared corners.
// Rounding is monotonic: fl(p.x q.y) - fl(p.y q.x) has the right sign or is zero. Zero is resolved in integers,
// and a true zero by Simulation of Simplicity (Edelsbrunner & Muecke 1990): every ray is moved by (d, d^2) for an
// infinitesimal d > 0, where it meets no edge and no corner:
//
//   (p - (d, d^2)) x (q - (d, d^2)) = p x q + d (p.y - q.y) + d^2 (q.x - p.x)
//
// The signs are thus those of one point in the plane of the sheared corners: an edge-on triangle never has three
// equal signs, and two triangles that share an edge or a corner never both miss or both hit the ray.

// Prevents fusing a product and a sum into one operation with a single rounding, which may give the wrong sign.
// The bound does not change results: sheared coordinates are below 1e19.
fn triangle_edge_rounded(products: vec2f) -> vec2f {
    return max(products, vec2f(-1.0e38));
}

// The edge functions of the corners a, b, c, up to a common scale.
fn triangle_edge_functions(a: vec2f, b: vec2f, c: vec2f) -> vec3f {
    let plus = max(vec3f(c.x, a.x, b.x) * vec3f(b.y, c.y, a.y), vec3f(-1.0e38));
    let minus = max(vec3f(c.y, a.y, b.y) * vec3f(b.x, c.x, a.x), vec3f(-1.0e38));
    return plus - minus;
}

fn triangle_edge_inside(edges: vec3f, a: vec2f, b: vec2f, c: vec2f) -> bool {
    let least = min(edges.x, min(edges.y, edges.z));
    let largest = max(edges.x, max(edges.y, edges.z));
    var inside = least > 0.0 || largest < 0.0;
    if !inside && (least == 0.0 || largest == 0.0) {
        let sign = triangle_edge_sign(edges.x, c, b);
        inside = sign != 0 && sign == triangle_edge_sign(edges.y, a, c) && sign == triangle_edge_sign(edges.z, b, a);
    }
    return inside;
}

// The sign of p x q; `rounded` is its value in f32. Zero only for equal points.
fn triangle_edge_sign(rounded: f32, p: vec2f, q: vec2f) -> i32 {
    if rounded != 0.0 {
        return select(-1, 1, rounded > 0.0);
    }
    let exact = triangle_edge_compare(triangle_edge_product(p.x, q.y), triangle_edge_product(p.y, q.x));
    if exact != 0 {
        return exact;
    }
    return select(triangle_edge_order(q.x, p.x), triangle_edge_order(p.y, q.y), p.y != q.y);
}

fn triangle_edge_order(x: f32, y: f32) -> i32 {
    return select(0, 1, x > y) - select(0, 1, x < y);
}

// (high 2^24 + low) 2^exponent with 2^23 <= high < 2^24; the sign is 0 for zero.
struct Product {
    sign: i32,
    exponent: i32,
    high: u32,
    low: u32,
}

fn triangle_edge_product(x: f32, y: f32) -> Product {
    let a = triangle_edge_mantissa(bitcast<u32>(x));
    let b = triangle_edge_mantissa(bitcast<u32>(y));
    if a.x == 0u || b.x == 0u {
        return Product(0, 0, 0u, 0u);
    }
    // Multiplies 24 x 24 bits by halves of 12 bits.
    let middle = (a.x >> 12u) * (b.x & 0xfffu) + (a.x & 0xfffu) * (b.x >> 12u);
    let low = (a.x & 0xfffu) * (b.x & 0xfffu) + ((middle & 0xfffu) << 12u);
    let high = (a.x >> 12u) * (b.x >> 12u) + (middle >> 12u) + (low >> 24u);
    let sign = 1 - 2 * i32((bitcast<u32>(x) ^ bitcast<u32>(y)) >> 31u);
    let exponent = bitcast<i32>(a.y) + bitcast<i32>(b.y);
    if high >= 0x800000u {
        return Product(sign, exponent + 1, high, low & 0xffffffu);
    }
    return Product(sign, exponent, (high << 1u) | ((low >> 23u) & 1u), (low << 1u) & 0xffffffu);
}

// The mantissa of 24 bits and the exponent (as i32) of a number; subnormal numbers are normalised.
fn triangle_edge_mantissa(bits: u32) -> vec2u {
    let biased = (bits >> 23u) & 0xffu;
    let fraction = bits & 0x7fffffu;
    if biased != 0u {
        return vec2u(fraction | 0x800000u, biased);
    }
    if fraction == 0u {
        return vec2u(0u);
    }
    let shift = countLeadingZeros(fraction) - 8u;
    return vec2u(fraction << shift, 1u - shift);
}

fn triangle_edge_compare(a: Product, b: Product) -> i32 {
    if a.sign != b.sign {
        return select(-1, 1, a.sign > b.sign);
    }
    let larger = triangle_edge_larger(a, b) - triangle_edge_larger(b, a);
    return a.sign * larger;
}

fn triangle_edge_larger(a: Product, b: Product) -> i32 {
    if a.exponent != b.exponent {
        return select(0, 1, a.exponent > b.exponent);
    }
    return select(0, 1, a.high > b.high || (a.high == b.high && a.low > b.low));
}

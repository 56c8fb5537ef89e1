// Edge functions computed with rounding, from differences to one corner of the triangle (after Moeller & Trumbore
// 1997): neighbours round a shared edge differently, so rays slip through between them. A baseline to measure the
// benefit and the cost of exact edges.

fn triangle_edge_rounded(products: vec2f) -> vec2f {
    return products;
}

fn triangle_edge_cross(p: vec2f, q: vec2f) -> f32 {
    return p.x * q.y - p.y * q.x;
}

fn triangle_edge_functions(a: vec2f, b: vec2f, c: vec2f) -> vec3f {
    let determinant = triangle_edge_cross(c - a, b - a);
    let v = triangle_edge_cross(a, c - a);
    let w = triangle_edge_cross(b - a, a);
    return vec3f(determinant - v - w, v, w);
}

fn triangle_edge_inside(edges: vec3f, a: vec2f, b: vec2f, c: vec2f) -> bool {
    return all(edges > vec3f(0.0)) || all(edges < vec3f(0.0));
}

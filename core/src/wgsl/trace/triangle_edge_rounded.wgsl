// Edge functions as they are often computed, from differences to one corner of the triangle (Moeller, Trumbore 1997 in
// the plane): neighbours round a shared edge differently, and rays slip through between them. What exact edges are worth
// and cost is measured against this.

fn edge_rounded(products: vec2f) -> vec2f {
    return products;
}

fn edge_cross(p: vec2f, q: vec2f) -> f32 {
    return p.x * q.y - p.y * q.x;
}

fn edge_functions(a: vec2f, b: vec2f, c: vec2f) -> vec3f {
    let determinant = edge_cross(c - a, b - a);
    let v = edge_cross(a, c - a);
    let w = edge_cross(b - a, a);
    return vec3f(determinant - v - w, v, w);
}

fn edge_inside(edges: vec3f, a: vec2f, b: vec2f, c: vec2f) -> bool {
    return all(edges > vec3f(0.0)) || all(edges < vec3f(0.0));
}

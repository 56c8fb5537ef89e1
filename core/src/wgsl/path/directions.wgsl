// Directions around a normal.

// A frame whose third column is the unit normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn directions_frame(n: vec3f) -> mat3x3f {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    let y = vec3f(b, side + n.y * n.y * a, -n.y);
    return mat3x3f(x, y, n);
}

// A cosine-weighted direction around a unit normal.
fn directions_cosine(n: vec3f, random: vec2f) -> vec3f {
    let r = sqrt(random.x);
    let angle = 2.0 * PI * random.y;
    let frame = directions_frame(n);
    return normalize(r * cos(angle) * frame[0] + r * sin(angle) * frame[1] + sqrt(max(0.0, 1.0 - random.x)) * n);
}

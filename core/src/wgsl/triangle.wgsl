// Ray against triangle, watertight along shared edges (Woop, Benthin, Wald 2013). Both sides count.
// Edge functions that are zero count as inside for both neighbours, so no ray slips between them; the paper's
// fall-back to double precision only decides which neighbour it is and is left out.

struct TriangleHit {
    t: f32,
    // Weights of the second and third corner.
    u: f32,
    v: f32,
    hit: bool,
}

// What depends on the ray alone: the axis of its largest component becomes z, the others are sheared away.
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

fn triangle_hit(shear: Shear, corners: array<vec3f, 3>, t_max: f32) -> TriangleHit {
    let a = triangle_permute(corners[0] - shear.origin, shear.axis);
    let b = triangle_permute(corners[1] - shear.origin, shear.axis);
    let c = triangle_permute(corners[2] - shear.origin, shear.axis);
    let a2 = a.xy - shear.shear.xy * a.z;
    let b2 = b.xy - shear.shear.xy * b.z;
    let c2 = c.xy - shear.shear.xy * c.z;
    let u = c2.x * b2.y - c2.y * b2.x;
    let v = a2.x * c2.y - a2.y * c2.x;
    let w = b2.x * a2.y - b2.y * a2.x;
    let outside = min(u, min(v, w)) < 0.0 && max(u, max(v, w)) > 0.0;
    let determinant = u + v + w;
    let t = shear.shear.z * (u * a.z + v * b.z + w * c.z) / determinant;
    let hit = !outside && determinant != 0.0 && t > 0.0 && t < t_max;
    return TriangleHit(t, v / determinant, w / determinant, hit);
}

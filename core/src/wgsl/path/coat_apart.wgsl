// Coats with normals of their own: mirror images of coat and surface are apart.

// The frame of a rough coat's lobe.
fn coat_frame(m: Material, frame: mat3x3f) -> mat3x3f {
    return directions_frame(m.coat_normal.normal);
}

// The part of the mirror lobe that is a smooth coat's.
fn coat_mirrored(m: Material, cosine: f32) -> f32 {
    let coat = material_coat(m);
    return select(0.0, 1.0 - material_coat_passes(m, cosine), coat.x > 0.0 && coat.y < LEAST_ROUGHNESS);
}

// A normal to mirror by, and the weight of the mirrored ray.
struct Mirrored {
    normal: vec3f,
    weight: vec3f,
}

fn coat_mirror(s: Surface, m: Material, lobes: Lobes, number: f32) -> Mirrored {
    let coat = coat_mirrored(m, lobes.cosine);
    if number - lobes.chances.x < coat {
        return Mirrored(m.coat_normal.normal, vec3f(lobes.sum));
    }
    return Mirrored(s.normal, (lobes.mirror - coat) * (lobes.sum / (lobes.chances.y - coat)));
}

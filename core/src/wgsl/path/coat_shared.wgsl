// For scenes whose coats have the normals of what they cover: one mirror image stands for both.

// The frame of a rough coat's lobe.
fn coat_frame(m: Material, frame: mat3x3f) -> mat3x3f {
    return frame;
}

// The part of the mirror lobe that has a normal of its own.
fn coat_mirrored(m: Material, cosine: f32) -> f32 {
    return 0.0;
}

// A normal to mirror by, and the weight of the mirrored ray.
struct Mirrored {
    normal: vec3f,
    weight: vec3f,
}

fn coat_mirror(s: Surface, m: Material, lobes: Lobes, number: f32) -> Mirrored {
    return Mirrored(s.normal, lobes.mirror * (lobes.sum / lobes.chances.y));
}

// For scenes whose coats have the normals of what they cover.

// Cosine of the view angle at the coat.
fn coat_cosine(m: Material, cosine: f32) -> f32 {
    return cosine;
}

// The coat's lobe for one light where it has the surface's normal.
fn coat_shared_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return material_coat_lobe(m, normal, view, light);
}

// Normal of the mirrored ray.
fn coat_reflecting(m: Material, normal: vec3f, cosine: f32, inside: bool) -> vec3f {
    return normal;
}

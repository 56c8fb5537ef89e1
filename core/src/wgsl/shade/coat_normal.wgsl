// Normals of clear coats over bumpy surfaces: that of the coat's own normal map, else that of the vertices.

struct CoatNormal {
    // Averaged normal of the coat's normal map in the tangent frame; zero without one.
    bump: vec3f,
    normal: vec3f,
    // Cosine of the angle between normal and view.
    cosine: f32,
}

// Reads the coat's normal map, whose bumps that are smaller than a pixel raise the coat's roughness.
fn coat_normal_read(m: ptr<function, Material>, record: u32, at: Lookup, maps: Maps) {
    let lookup = material_lookup(record, SLOT_CLEARCOATNORMAL, at, maps);
    if (lookup.place.z & TEXTURE_PRESENT) == 0u {
        return;
    }
    let average = 2.0 * texture_data(lookup.place, lookup.texcoord, lookup.footprint).rgb - 1.0;
    let scale = bitcast<f32>(object_part(0u, record + 3u).z);
    (*m).coat.y = material_toksvig((*m).coat.y, length(average));
    (*m).coat_normal.bump = average * vec3f(scale, scale, 1.0);
}

// Finds the coat's normal from that of the vertices.
fn coat_orient(m: ptr<function, Material>, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) {
    let bent = material_bent((*m).coat_normal.bump, (*m).coat.y < 0.5, normal, face, view, maps);
    (*m).coat_normal.normal = bent;
    (*m).coat_normal.cosine = clamp(dot(bent, view), 0.0, 1.0);
}

// Cosine of the view angle at the coat.
fn coat_cosine(m: Material, cosine: f32) -> f32 {
    return m.coat_normal.cosine;
}

// The coat's lobe for one light where it has the surface's normal.
fn coat_shared_lobe(m: Material, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return vec3f(0.0);
}

// Normal of the one mirrored ray: that of the layer that mirrors more.
fn coat_reflecting(m: Material, normal: vec3f, cosine: f32, inside: bool) -> vec3f {
    let coat = material_coat_mirror(m, cosine).x;
    let below = material_mirror(m, cosine, inside) - coat;
    return select(normal, m.coat_normal.normal, coat > max(below.x, max(below.y, below.z)));
}

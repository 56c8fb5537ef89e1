// Mirrors that show an environment map. Where the mirrored rays of both references met nothing, that of a sample between
// them is taken to meet nothing either: its radiance is looked up in the map, in full detail, and check GC passes.

fn similarity_mirrors(a: Attributes, b: Attributes) -> bool {
    return a.mirrors_environment && b.mirrors_environment && frame.tolerances.gcol > 0.0;
}

// Radiance of a sample's secondary rays; `view` is the unit vector to the viewer.
fn similarity_secondary(a: Attributes, m: Material, normal: vec3f, view: vec3f, covered: f32) -> vec3f {
    if !a.mirrors_environment {
        return a.gcol;
    }
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let weight = covered * material_mirror(m, cosine, false);
    let reflected = reflect(-view, coat_reflecting(m, normal, cosine, false));
    return weight * environment_missed(RAY_REFLECTION | environment_kind(m), reflected);
}

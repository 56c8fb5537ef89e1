// For scenes without mirrors, or with a constant environment.

fn similarity_mirrors(a: Attributes, b: Attributes) -> bool {
    return false;
}

fn similarity_secondary(a: Attributes, m: Material, normal: vec3f, view: vec3f, covered: f32) -> vec3f {
    return a.gcol;
}

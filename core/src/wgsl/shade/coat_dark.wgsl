// For scenes without coats that have normals of their own, or without punctual lights.

fn coat_lit(m: Material, position: vec3f, view: vec3f, shadow: u32) -> vec3f {
    return vec3f(0.0);
}

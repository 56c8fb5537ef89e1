// For scenes without extended materials.

fn material_normal(m: Material, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) -> vec3f {
    return normal;
}

fn coat_orient(m: ptr<function, Material>, normal: vec3f, face: vec3f, view: vec3f, maps: Maps) {}

fn material_has_normal_map(object: u32) -> bool {
    return false;
}

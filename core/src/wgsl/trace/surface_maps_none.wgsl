// For scenes without extended materials: surfaces have no tangents, and no coordinates but their first ones.

fn surface_maps(s: Surface, hit: Hit, corners: array<vec3f, 3>, direction: vec3f) -> Maps {
    return Maps(0u);
}

// The material of a surface; `direction` is the unit direction of the incident ray.
fn surface_material(s: ptr<function, Surface>, direction: vec3f) -> Material {
    return material_at((*s).object, (*s).texcoord, (*s).footprint, (*s).color, (*s).maps);
}

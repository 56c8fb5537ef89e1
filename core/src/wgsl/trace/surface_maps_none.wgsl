// For scenes without extended materials: surfaces have no tangents, and no coordinates but their first ones.

fn surface_maps(s: Surface, hit: Hit, corners: array<vec3f, 3>, direction: vec3f) -> Maps {
    return Maps(0u);
}

// Transmittance of what the ray has crossed.
fn surface_absorbed(s: Surface, ray: Ray) -> vec3f {
    return vec3f(1.0);
}

// The material of a surface; `direction` is the unit direction of the incident ray.
fn surface_material(s: ptr<function, Surface>, direction: vec3f) -> Material {
    return material_at((*s).object, (*s).texcoord, (*s).footprint, (*s).color, (*s).maps);
}

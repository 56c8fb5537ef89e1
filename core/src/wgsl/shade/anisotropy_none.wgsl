// For scenes without anisotropic lobes.

fn anisotropy_widest(m: Material) -> f32 {
    return m.roughness;
}

fn anisotropy_normal(m: Material, normal: vec3f, view: vec3f) -> vec3f {
    return normal;
}

fn anisotropy_lobe(m: Material, f0: vec3f, f90: vec3f, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    return material_microfacets(f0, f90, m.roughness, normal, view, light);
}

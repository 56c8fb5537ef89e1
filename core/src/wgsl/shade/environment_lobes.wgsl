// Reflection of an environment map: the diffuse lobe, and the part of the specular lobe that is not traced as a mirror.

// The bits of a ray's kind that tell the roughness of the surface that it leaves.
fn environment_kind(m: Material) -> u32 {
    return u32(clamp(m.roughness, 0.0, 1.0) * 255.0 + 0.5) << 8u;
}

// Reflectance of microfacets for light from all directions, from those of one at normal and at grazing incidence: single
// scattering (Karis 2014, "Physically Based Shading on Mobile") and what is scattered several times (Fdez-Aguera 2019, "A
// Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting").
fn environment_reflectance(f0: vec3f, f90: vec3f, roughness: f32, cosine: f32) -> vec3f {
    let r = roughness * vec4f(-1.0, -0.0275, -0.572, 0.022) + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    let single = max(f0 * (r.z - 1.04 * a) + f90 * (r.w + 1.04 * a), vec3f(0.0));
    let average = f0 + (f90 - f0) / 21.0;
    let missing = 1.0 - r.z - r.w;
    return min(single + missing * single * average / (1.0 - missing * average), vec3f(1.0));
}

// Direction in which the filtered map holds the radiance that a rough surface reflects: between those of the mirrored ray
// and of the normal (Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", 4.9.3), by alpha. Of any
// length but zero.
fn environment_dominant(m: Material, cosine: f32, normal: vec3f, view: vec3f) -> vec3f {
    return mix(2.0 * cosine * normal - view, normal, m.roughness * m.roughness);
}

// Share of ambient light that the specular lobe of the dielectric part leaves to diffuse lobes.
fn environment_passed(m: Material, cosine: f32) -> vec3f {
    let f0 = iridescence_over(m, 0.0, material_f0(m), cosine, 0.0);
    let f90 = iridescence_over(m, 0.0, material_f90(m), cosine, 0.0);
    return 1.0 - environment_reflectance(f0, f90, m.roughness, cosine) * (1.0 - material_gloss(m));
}

fn environment_reflected(m: Material, diffuse: vec3f, normal: vec3f, view: vec3f) -> vec3f {
    let ambient = environment_ambient(normal);
    if material_is(m, OBJECT_WEIGHTS) {
        return diffuse * ambient;
    }
    let cosine = clamp(dot(normal, view), 0.0, 1.0);
    let rough = 1.0 - material_gloss(m);
    let f0 = iridescence_over(m, 0.0, material_f0(m), cosine, 0.0);
    let f90 = iridescence_over(m, 0.0, material_f90(m), cosine, 0.0);
    let dielectric = environment_reflectance(f0, f90, m.roughness, cosine) * rough;
    let metal_f0 = iridescence_over(m, 1.0, m.base, cosine, 0.0);
    let metal_f90 = iridescence_over(m, 1.0, vec3f(1.0), cosine, 0.0);
    let metal = environment_reflectance(metal_f0, metal_f90, m.roughness, cosine) * (m.metallic * rough);
    let specular = metal + (1.0 - m.metallic) * dielectric;
    let sheen = material_coat_passes(m, cosine) * material_sheen_albedo(m, cosine) * ambient;
    let matte = diffuse * ambient;
    if max(specular.x, max(specular.y, specular.z)) <= 0.0 {
        return matte + sheen;
    }
    let bent = anisotropy_normal(m, normal, view);
    let toward = clamp(dot(bent, view), 0.0, 1.0);
    let lobe = environment_lobe(environment_dominant(m, toward, bent, view), m.roughness);
    let seen = material_sheen_passes(m, cosine) * lobe;
    return matte + metal * seen + dielectric * ((1.0 - m.metallic) * seen - matte) + sheen;
}
